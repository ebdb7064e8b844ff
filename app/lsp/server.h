// The language server: takes messages of the Language Server Protocol 3.17, and sends messages. It has one thread. Changes
// that have already arrived are taken together before graphs are checked again. Every request is answered by a result or an
// error.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>

#include "app/lsp/files/workspace.h"

namespace weft::app::lsp {

class Server {
 public:
  using Send = std::function<void(const Json&)>;
  Server(const Options& options, Send send) : send_(std::move(send)), workspace_(options, texts_) {}

  // Handles one message, given as its JSON text.
  void take(std::string_view text);
  // Answers what was no message.
  void refuse(const std::string& problem);
  // To be called when no more messages wait: checks what has changed, and publishes diagnostics.
  void settle();
  // The exit code after "exit"; nothing before.
  std::optional<int> ended() const { return ended_; }

 private:
  void fail(const Json& id, int code, const std::string& message);
  void request(const Json& id, const std::string& method, const Json& parameters);
  void notify(const std::string& method, const Json& parameters);
  Json answer(const std::string& method, const Json& parameters);
  Json initialize(const Json& parameters);
  void change(const Json& parameters);
  void publish(const std::string& path);
  Json toJson(const text::Diagnostic& diagnostic, const Text& text) const;

  Send send_;
  Texts texts_;
  Workspace workspace_;
  std::set<std::string> changed_;    // since the last settle()
  std::set<std::string> published_;  // files of which the editor shows messages
  bool initialized_ = false, shutDown_ = false;
  std::optional<int> ended_;
};

}  // namespace weft::app::lsp
