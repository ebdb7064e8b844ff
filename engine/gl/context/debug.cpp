#include "engine/gl/context/debug.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace weft::gl {

namespace {

// The enums that this room meets in messages.
// clang-format off
#define WEFT_ENUMS(X) \
  X(GL_INVALID_ENUM) X(GL_INVALID_VALUE) X(GL_INVALID_OPERATION) X(GL_INVALID_FRAMEBUFFER_OPERATION) \
  X(GL_OUT_OF_MEMORY) X(GL_CONTEXT_LOST) X(GL_TEXTURE_2D) X(GL_TEXTURE_2D_ARRAY) X(GL_TEXTURE_CUBE_MAP) \
  X(GL_TEXTURE_CUBE_MAP_ARRAY) X(GL_TEXTURE_3D) X(GL_TEXTURE_2D_MULTISAMPLE) \
  X(GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT) X(GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE) \
  X(GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT) X(GL_FRAMEBUFFER_INCOMPLETE_LAYER_TARGETS) \
  X(GL_FRAMEBUFFER_UNSUPPORTED) X(GL_DEPTH_ATTACHMENT) X(GL_STENCIL_ATTACHMENT) \
  X(GL_DEPTH_STENCIL_ATTACHMENT) X(GL_COLOR_ATTACHMENT0) X(GL_R8) X(GL_RG8) X(GL_RGBA8) X(GL_SRGB8_ALPHA8) \
  X(GL_R8_SNORM) X(GL_RG8_SNORM) X(GL_RGBA8_SNORM) X(GL_R16) X(GL_RG16) X(GL_RGBA16) X(GL_R16F) \
  X(GL_RG16F) X(GL_RGBA16F) X(GL_R32F) X(GL_RG32F) X(GL_RGBA32F) X(GL_R11F_G11F_B10F) X(GL_RGB10_A2) \
  X(GL_RGB9_E5) X(GL_R8UI) X(GL_R16UI) X(GL_R32UI) X(GL_RG16UI) X(GL_RG32UI) X(GL_RGBA8UI) X(GL_RGBA16UI) \
  X(GL_RGBA32UI) X(GL_R32I) X(GL_RG32I) X(GL_RGBA32I) X(GL_DEPTH_COMPONENT16) X(GL_DEPTH_COMPONENT24) \
  X(GL_DEPTH_COMPONENT32F) X(GL_DEPTH24_STENCIL8) X(GL_DEPTH32F_STENCIL8)
// clang-format on
#define WEFT_NAME(name) {name, #name},
constexpr std::pair<GLenum, const char*> kNames[] = {WEFT_ENUMS(WEFT_NAME)};
#undef WEFT_NAME
#undef WEFT_ENUMS

void GLAPIENTRY receive(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length, const GLchar* text,
                        const void* user) {
  const std::size_t size = length >= 0 ? static_cast<std::size_t>(length) : std::string_view(text).size();
  static_cast<DebugLog*>(const_cast<void*>(user))->record(type, severity, {text, size});
}

}  // namespace

void DebugLog::install() {
  groups_.reserve(64);
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
  glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DEBUG_SEVERITY_NOTIFICATION, 0, nullptr, GL_FALSE);
  // How a driver came to its speed, and what it tells besides, is nothing that a graph could mend.
  for (const GLenum type : {GL_DEBUG_TYPE_PERFORMANCE, GL_DEBUG_TYPE_OTHER})
    glDebugMessageControl(GL_DONT_CARE, type, GL_DONT_CARE, 0, nullptr, GL_FALSE);
  // workarounds.md: compiler-messages-twice
  glDebugMessageControl(GL_DEBUG_SOURCE_SHADER_COMPILER, GL_DEBUG_TYPE_ERROR, GL_DONT_CARE, 0, nullptr,
                        GL_FALSE);
  glDebugMessageCallback(receive, this);
}

void DebugLog::record(GLenum type, GLenum severity, std::string_view text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\0' || text.back() == ' '))
    text.remove_suffix(1);
  for (Message& m : messages_)
    if (m.type == type && m.severity == severity && m.text == text) {
      ++m.count;
      return;
    }
  messages_.push_back({.type = type,
                       .severity = severity,
                       .text = std::string(text),
                       .group = groups_.empty() ? std::string() : std::string(groups_.back())});
}

void DebugLog::drain(text::Diagnostics& diagnostics) {
  for (; drained_ < messages_.size(); ++drained_) {
    const Message& m = messages_[drained_];
    const bool error = m.severity == GL_DEBUG_SEVERITY_HIGH || m.type == GL_DEBUG_TYPE_ERROR;
    std::string text = fmt::format("OpenGL: {}", m.text);
    if (m.count > 1) text += fmt::format(" (seen {} times)", m.count);
    diagnostics.add({.severity = error ? text::Severity::error : text::Severity::warning,
                     .code = text::Code::driverMessage,
                     .message = std::move(text),
                     .pass = m.group});
  }
}

void DebugLog::clear() {
  messages_.clear();
  drained_ = 0;
}

DebugGroup::DebugGroup(DebugLog& log, std::string_view name) : log_(log) {
  log_.groups_.push_back(name);
  static const GLsizei limit = std::max(integerOf(GL_MAX_DEBUG_MESSAGE_LENGTH), 256) - 1;
  glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, std::min(static_cast<GLsizei>(name.size()), limit),
                   name.data());
}

DebugGroup::~DebugGroup() {
  glPopDebugGroup();
  log_.groups_.pop_back();
}

void labelObject(GLenum identifier, GLuint id, std::string_view label) {
  static const GLsizei limit = std::max(integerOf(GL_MAX_LABEL_LENGTH), 256) - 1;
  glObjectLabel(identifier, id, std::min(static_cast<GLsizei>(label.size()), limit), label.data());
}

GLint integerOf(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
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
