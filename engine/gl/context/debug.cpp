#include "engine/gl/context/debug.h"

#include <fmt/format.h>

#include <algorithm>

namespace weft::gl {

namespace {

const char* sourceName(GLenum source) {
  switch (source) {
    case GL_DEBUG_SOURCE_API:
      return "API";
    case GL_DEBUG_SOURCE_WINDOW_SYSTEM:
      return "window system";
    case GL_DEBUG_SOURCE_SHADER_COMPILER:
      return "shader compiler";
    case GL_DEBUG_SOURCE_THIRD_PARTY:
      return "third party";
    case GL_DEBUG_SOURCE_APPLICATION:
      return "application";
    default:
      return "other source";
  }
}

const char* typeName(GLenum type) {
  switch (type) {
    case GL_DEBUG_TYPE_ERROR:
      return "error";
    case GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR:
      return "deprecated behaviour";
    case GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR:
      return "undefined behaviour";
    case GL_DEBUG_TYPE_PORTABILITY:
      return "portability";
    case GL_DEBUG_TYPE_PERFORMANCE:
      return "performance";
    case GL_DEBUG_TYPE_MARKER:
      return "marker";
    default:
      return "message";
  }
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
    std::string text = fmt::format("OpenGL {} ({}): {}", typeName(m.type), sourceName(m.source), m.text);
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
  static const GLsizei limit = [] {
    GLint value = 1024;
    glGetIntegerv(GL_MAX_DEBUG_MESSAGE_LENGTH, &value);
    return static_cast<GLsizei>(value - 1);
  }();
  glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, std::min(static_cast<GLsizei>(name.size()), limit),
                   name.data());
}

DebugGroup::~DebugGroup() {
  glPopDebugGroup();
  const std::lock_guard lock(log_.mutex_);
  log_.groups_.pop_back();
}

void labelObject(GLenum identifier, GLuint id, std::string_view label) {
  static const GLsizei limit = [] {
    GLint value = 256;
    glGetIntegerv(GL_MAX_LABEL_LENGTH, &value);
    return static_cast<GLsizei>(value - 1);
  }();
  glObjectLabel(identifier, id, std::min(static_cast<GLsizei>(label.size()), limit), label.data());
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
