// The language server: messages in, messages out, of the Language Server Protocol 3.17. One thread; changes that are there
// already are taken together before graphs are looked at again. Whatever comes in is answered by a result or an error.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>

#include "app/lsp/files/analysis.h"
#include "app/lsp/files/project.h"

namespace weft::app::lsp {

class Server {
 public:
  using Send = std::function<void(const Json&)>;
  Server(const Options& options, Send send)
      : send_(std::move(send)), project_(texts_), analysis_(options, texts_, project_) {}

  // The text of one message.
  void take(std::string_view text);
  void refuse(const std::string& problem);  // of what was no message
  // To be called when no more messages wait: looks at what has changed and publishes what is wrong.
  void settle();
  // The exit code, after "exit".
  std::optional<int> ended() const { return ended_; }

 private:
  void fail(const Json& id, int code, const std::string& message);
  void request(const Json& id, const std::string& method, const Json& parameters);
  void notify(const std::string& method, const Json& parameters);
  Json answer(const std::string& method, const Json& parameters);
  Json initialize(const Json& parameters);
  void change(const Json& parameters);
  void rename(const Json& id, const Json& parameters);
  void publish(const std::string& path);
  Json toJson(const base::Diagnostic& diagnostic, const Text& text) const;

  Send send_;
  Texts texts_;
  Project project_;
  Analysis analysis_;
  std::set<std::string> changed_;    // since the last settle()
  std::set<std::string> published_;  // files of which the editor shows messages
  bool initialized_ = false, shutDown_ = false;
  std::optional<int> ended_;
};

}  // namespace weft::app::lsp
