#include "engine/gl/context/debug.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace weft::gl {

namespace {

// The enums that this room meets in messages.
#define WEFT_NAME(name) \
  { name, #name }
constexpr std::pair<GLenum, const char*> kNames[] = {WEFT_NAME(GL_INVALID_ENUM),
                                                     WEFT_NAME(GL_INVALID_VALUE),
                                                     WEFT_NAME(GL_INVALID_OPERATION),
                                                     WEFT_NAME(GL_INVALID_FRAMEBUFFER_OPERATION),
                                                     WEFT_NAME(GL_OUT_OF_MEMORY),
                                                     WEFT_NAME(GL_CONTEXT_LOST),
                                                     WEFT_NAME(GL_TEXTURE_2D),
                                                     WEFT_NAME(GL_TEXTURE_2D_ARRAY),
                                                     WEFT_NAME(GL_TEXTURE_CUBE_MAP),
                                                     WEFT_NAME(GL_TEXTURE_CUBE_MAP_ARRAY),
                                                     WEFT_NAME(GL_TEXTURE_3D),
                                                     WEFT_NAME(GL_TEXTURE_2D_MULTISAMPLE),
                                                     WEFT_NAME(GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT),
                                                     WEFT_NAME(GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE),
                                                     WEFT_NAME(GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT),
                                                     WEFT_NAME(GL_FRAMEBUFFER_INCOMPLETE_LAYER_TARGETS),
                                                     WEFT_NAME(GL_FRAMEBUFFER_UNSUPPORTED),
                                                     WEFT_NAME(GL_DEPTH_ATTACHMENT),
                                                     WEFT_NAME(GL_STENCIL_ATTACHMENT),
                                                     WEFT_NAME(GL_DEPTH_STENCIL_ATTACHMENT),
                                                     WEFT_NAME(GL_COLOR_ATTACHMENT0),
                                                     WEFT_NAME(GL_R8),
                                                     WEFT_NAME(GL_RG8),
                                                     WEFT_NAME(GL_RGBA8),
                                                     WEFT_NAME(GL_SRGB8_ALPHA8),
                                                     WEFT_NAME(GL_R8_SNORM),
                                                     WEFT_NAME(GL_RG8_SNORM),
                                                     WEFT_NAME(GL_RGBA8_SNORM),
                                                     WEFT_NAME(GL_R16),
                                                     WEFT_NAME(GL_RG16),
                                                     WEFT_NAME(GL_RGBA16),
                                                     WEFT_NAME(GL_R16F),
                                                     WEFT_NAME(GL_RG16F),
                                                     WEFT_NAME(GL_RGBA16F),
                                                     WEFT_NAME(GL_R32F),
                                                     WEFT_NAME(GL_RG32F),
                                                     WEFT_NAME(GL_RGBA32F),
                                                     WEFT_NAME(GL_R11F_G11F_B10F),
                                                     WEFT_NAME(GL_RGB10_A2),
                                                     WEFT_NAME(GL_RGB9_E5),
                                                     WEFT_NAME(GL_R8UI),
                                                     WEFT_NAME(GL_R16UI),
                                                     WEFT_NAME(GL_R32UI),
                                                     WEFT_NAME(GL_RG16UI),
                                                     WEFT_NAME(GL_RG32UI),
                                                     WEFT_NAME(GL_RGBA8UI),
                                                     WEFT_NAME(GL_RGBA16UI),
                                                     WEFT_NAME(GL_RGBA32UI),
                                                     WEFT_NAME(GL_R32I),
                                                     WEFT_NAME(GL_RG32I),
                                                     WEFT_NAME(GL_RGBA32I),
                                                     WEFT_NAME(GL_DEPTH_COMPONENT16),
                                                     WEFT_NAME(GL_DEPTH_COMPONENT24),
                                                     WEFT_NAME(GL_DEPTH_COMPONENT32F),
                                                     WEFT_NAME(GL_DEPTH24_STENCIL8),
                                                     WEFT_NAME(GL_DEPTH32F_STENCIL8)};
#undef WEFT_NAME

GLsizei limitOf(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return std::max(value, 256) - 1;
}

void GLAPIENTRY receive(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                        const GLchar* text, const void* user) {
  const std::size_t size = length >= 0 ? static_cast<std::size_t>(length) : std::string_view(text).size();
  static_cast<DebugLog*>(const_cast<void*>(user))->record(source, type, id, severity, {text, size});
}

}  // namespace

void DebugLog::install() {
  groups_.reserve(64);
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
  for (const GLenum marker : {GL_DEBUG_TYPE_PUSH_GROUP, GL_DEBUG_TYPE_POP_GROUP})
    glDebugMessageControl(GL_DONT_CARE, marker, GL_DONT_CARE, 0, nullptr, GL_FALSE);
  // workarounds.h: compiler-messages-twice
  for (const GLenum type : {GL_DEBUG_TYPE_ERROR, GL_DEBUG_TYPE_OTHER})
    glDebugMessageControl(GL_DEBUG_SOURCE_SHADER_COMPILER, type, GL_DONT_CARE, 0, nullptr, GL_FALSE);
  glDebugMessageCallback(receive, this);
}

void DebugLog::record(GLenum source, GLenum type, GLuint id, GLenum severity, std::string_view text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\0' || text.back() == ' '))
    text.remove_suffix(1);
  const std::lock_guard lock(mutex_);
  const auto same = std::find_if(messages_.begin(), messages_.end(), [&](const DebugMessage& m) {
    return m.source == source && m.type == type && m.id == id && m.severity == severity && m.text == text;
  });
  if (same != messages_.end()) {
    ++same->count;
    return;
  }
  messages_.push_back({source, type, severity, id, std::string(text),
                       groups_.empty() ? std::string() : std::string(groups_.back()), 1});
}

bool DebugLog::hasAboveNotification() const {
  const std::lock_guard lock(mutex_);
  return std::any_of(messages_.begin(), messages_.end(),
                     [](const DebugMessage& m) { return m.severity != GL_DEBUG_SEVERITY_NOTIFICATION; });
}

std::vector<DebugMessage> DebugLog::messages() const {
  const std::lock_guard lock(mutex_);
  return messages_;
}

void DebugLog::drain(base::Diagnostics& diagnostics, bool notifications) {
  const std::lock_guard lock(mutex_);
  for (; drained_ < messages_.size(); ++drained_) {
    const DebugMessage& m = messages_[drained_];
    base::Severity severity = base::Severity::warning;
    if (m.severity == GL_DEBUG_SEVERITY_NOTIFICATION) {
      if (!notifications) continue;
      severity = base::Severity::note;
    } else if (m.severity == GL_DEBUG_SEVERITY_HIGH || m.type == GL_DEBUG_TYPE_ERROR) {
      severity = base::Severity::error;
    }
    std::string text = fmt::format("OpenGL: {}", m.text);
    if (m.count > 1) text += fmt::format(" (seen {} times)", m.count);
    diagnostics.add({.severity = severity,
                     .code = base::Code::driverMessage,
                     .message = std::move(text),
                     .place = {},
                     .pass = m.group});
  }
}

void DebugLog::clear() {
  const std::lock_guard lock(mutex_);
  messages_.clear();
  drained_ = 0;
}

DebugGroup::DebugGroup(DebugLog& log, std::string_view name) : log_(log) {
  {
    const std::lock_guard lock(log_.mutex_);
    log_.groups_.push_back(name);
  }
  static const GLsizei limit = limitOf(GL_MAX_DEBUG_MESSAGE_LENGTH);
  glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, std::min(static_cast<GLsizei>(name.size()), limit),
                   name.data());
}

DebugGroup::~DebugGroup() {
  glPopDebugGroup();
  const std::lock_guard lock(log_.mutex_);
  log_.groups_.pop_back();
}

void labelObject(GLenum identifier, GLuint id, std::string_view label) {
  static const GLsizei limit = limitOf(GL_MAX_LABEL_LENGTH);
  glObjectLabel(identifier, id, std::min(static_cast<GLsizei>(label.size()), limit), label.data());
}

std::string enumName(GLenum value) {
  const auto found = std::ranges::find(kNames, value, &std::pair<GLenum, const char*>::first);
  return found == std::end(kNames) ? fmt::format("0x{:04X}", value) : found->second;
}

std::string takeErrors() {
  std::string names;
  for (int i = 0; i < 16; ++i) {  // a lost context reports for ever
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) break;
    names += (names.empty() ? "" : ", ") + enumName(error);
  }
  return names;
}

}  // namespace weft::gl
