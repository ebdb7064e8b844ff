// What an editor sends to the language server: a message a line; "@/" is the URI of a workspace.
#include "app/lsp/lsp.cpp"  // the server is in no header

#include <sstream>

#include "tests/fuzz/fuzz.h"

namespace weft::fuzz {

void fuzz(std::string_view input) {
  using app::lsp::Json;
  static const app::Options options;
  static const std::string workspace = text::uriOf(GivenFile::pathOf("app/lsp/workspace/"));
  std::string messages(input);
  for (std::size_t at = 0; (at = messages.find("@/", at)) != std::string::npos; at += workspace.size())
    messages.replace(at, 2, workspace);
  std::set<std::string> opened;
  {
    app::lsp::Server server(options);
    std::istringstream lines(messages);
    for (std::string line; !server.ended() && std::getline(lines, line);) {
      server.take(line);
      server.settle();
      const Json message = Json::parse(line, nullptr, false);
      const Json::json_pointer uri("/params/textDocument/uri");
      if (message.is_object() && message.contains(uri) && message[uri].is_string())
        opened.insert(app::lsp::pathOfUri(message[uri].get<std::string>()));
    }
  }
  for (const std::string& path : opened) text::dropOverlay(path);
}

}  // namespace weft::fuzz
