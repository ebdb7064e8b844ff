#include "app/lsp/lsp.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <exception>
#include <iostream>
#include <map>
#include <optional>
#include <set>

#include "app/lsp/workspace.h"
#include "app/output/standard_streams.h"
#include "engine/text/chars.h"
#include "engine/text/json/report.h"
#include "engine/text/printable.h"

namespace weft::app {

namespace lsp {

namespace {

// Error codes of the protocol.
constexpr int kParseError = -32700, kInvalidRequest = -32600, kUnknownMethod = -32601,
              kInvalidParameters = -32602, kInternalError = -32603, kRequestFailed = -32803;

// Thrown where a message cannot be answered; caught where it is.
struct Failure {
  int code;
  std::string what;
};

[[noreturn]] void failToRead(const std::string& where, std::string_view read) {
  throw Failure{kRequestFailed,
                fmt::format("the input ended {}: '{}'", where, text::printable(text::shortened(read)))};
}

// The next message: header lines, an empty line, and as many bytes of JSON as Content-Length says. Throws a Failure where the input
// ends, or has no such header.
std::string readMessage() {
  constexpr std::size_t kMaxHeader = 4096, kMaxMessage = std::size_t{64} << 20;  // bytes
  std::string header;
  for (char c = 0; !header.ends_with("\r\n\r\n"); header += c)
    if (header.size() > kMaxHeader || !std::cin.get(c)) {
      if (header.empty()) throw Failure{kRequestFailed, "the input ended without 'exit'"};
      failToRead("within a header", header);
    }
  constexpr std::string_view kLength = "content-length: ";
  const std::string words = text::lowered(header);
  const std::size_t at = words.find(kLength);
  std::size_t bytes = kMaxMessage + 1;
  if (at != words.npos) std::from_chars(&words[at] + kLength.size(), words.data() + words.size(), bytes);
  if (bytes > kMaxMessage)
    failToRead(fmt::format("at a header without 'Content-Length: ' and a number up to {}", kMaxMessage),
               header);
  std::string message(bytes, '\0');
  std::cin.read(message.data(), static_cast<std::streamsize>(bytes));
  message.resize(static_cast<std::size_t>(std::cin.gcount()));
  if (message.size() < bytes)
    failToRead(fmt::format("after {} of {} bytes of a message", message.size(), bytes), message);
  return message;
}

void send(const Json& message) {
  const std::string text = text::dumpJson(message, -1, false);
  print(fmt::format("Content-Length: {}\r\n\r\n{}", text.size(), text));
  flushPrinted();
}

std::string pathOf(const Json& document) {
  const std::string& uri = document.at("uri").get_ref<const std::string&>();
  std::string path = pathOfUri(uri);
  if (path.empty())
    throw Failure{kInvalidParameters,
                  fmt::format("expected a file: URI, found '{}'", text::printable(text::shortened(uri)))};
  return path;
}

Json diagnosticJson(const text::Diagnostic& d, const Text& text) {
  const std::string_view all = text.bytes();
  const std::size_t begin = d.place.line > 0 ? text::offsetOf(all, d.place.inFile()) : 0;
  // The range grows to the end of the word or the string there.
  std::size_t end = begin;
  if (begin < all.size() && all[begin] == '"') {
    end = std::min(all.find_first_of("\"\n", begin + 1), all.size());
    if (end < all.size() && all[end] == '"') ++end;
  }
  while (end < all.size() && all[begin] != '"' && (text::isIdentChar(all[end]) || all[end] == '.')) ++end;
  if (end == begin && end < all.size() && all[end] != '\n') ++end;
  std::string message = d.message;
  using Line = std::pair<const char*, const std::string&>;
  for (const auto& [label, said] : {Line{"expected", d.expected}, {"found", d.found}, {"fix", d.hint}})
    if (!said.empty()) message += fmt::format("\n{}: {}", label, text::shortened(said));
  return {{"range", text.toJson({begin, end})},
          {"severity", 3 - static_cast<int>(d.severity)},
          {"code", text::nameOf(d.code)},
          {"source", "weft"},
          {"message", std::move(message)}};
}

// Takes and sends messages. Changes that have already arrived are taken together before graphs are checked again.
class Server {
 public:
  explicit Server(const Options& options) : workspace_(options, texts_) {}

  // Handles one message, given as its JSON text.
  void take(std::string_view text) {
    const Json message = text::loadJson(text);
    if (message.is_discarded()) return fail(nullptr, kParseError, "the message is no JSON");
    const auto id = message.find("id"), method = message.find("method"), given = message.find("params");
    const bool asks = id != message.end();
    if (method == message.end() || !method->is_string()) {
      if (!message.contains("result") && !message.contains("error"))  // an answer to us
        fail(nullptr, kInvalidRequest, "\"method\": expected a string");
      return;
    }
    if (asks && !id->is_string() && !id->is_number_integer())
      return fail(nullptr, kInvalidRequest, "\"id\": expected a string or a whole number");
    static const Json kNothing = Json::object();
    const Json& parameters = given == message.end() ? kNothing : *given;
    const std::string& name = method->get_ref<const std::string&>();
    try {
      if (asks)
        send({{"jsonrpc", "2.0"}, {"id", *id}, {"result", answer(name, parameters)}});
      else
        notify(name, parameters);
    } catch (const Failure& failure) {
      if (asks) fail(*id, failure.code, failure.what);
    } catch (const Json::exception& thrown) {
      if (asks) fail(*id, kInvalidParameters, thrown.what());
    } catch (const std::exception& thrown) {  // a library threw: that ends an answer, not the server
      if (asks) fail(*id, kInternalError, thrown.what());
    }
  }

  // To be called when no more messages wait: checks what has changed, and publishes diagnostics.
  void settle() {
    workspace_.look();
    if (changed_.empty()) return;
    workspace_.check();
    std::map<std::string, text::Diagnostics> said = workspace_.diagnostics();
    for (const std::string& path : changed_) said[path];
    for (const auto& [path, shown] : published_) said[path];
    for (const auto& [path, diagnostics] : said) {
      const std::shared_ptr<const Text> text = texts_.of(path);
      const Text nothing(path, "");
      Json list = Json::array();
      for (const text::Diagnostic& each : diagnostics.items())
        list.push_back(diagnosticJson(each, text ? *text : nothing));
      const auto opened = texts_.opened().find(path);
      const bool fresh = opened != texts_.opened().end() && changed_.contains(path);
      const auto shown = published_.find(path);
      if (!fresh && list == (shown == published_.end() ? Json::array() : shown->second)) continue;
      if (list.empty())
        published_.erase(path);
      else
        published_[path] = list;
      Json parameters{{"uri", text::uriOf(path)}};
      if (opened != texts_.opened().end()) parameters["version"] = opened->second.version;
      parameters["diagnostics"] = std::move(list);
      send({{"jsonrpc", "2.0"},
            {"method", "textDocument/publishDiagnostics"},
            {"params", std::move(parameters)}});
    }
    changed_.clear();
  }

  // The exit code after "exit"; nothing before.
  std::optional<int> ended() const { return ended_; }

 private:
  void fail(const Json& id, int code, const std::string& message) {
    send({{"jsonrpc", "2.0"}, {"id", id}, {"error", {{"code", code}, {"message", message}}}});
  }

  Json answer(const std::string& method, const Json& parameters) {
    if (shutDown_) throw Failure{kInvalidRequest, "the server was shut down"};
    if (method == "initialize") return initialize(parameters);
    if (method == "shutdown") {
      shutDown_ = true;
      return nullptr;
    }
    constexpr std::string_view kMethods[] = {"textDocument/completion", "textDocument/hover",
                                             "textDocument/definition", "textDocument/references",
                                             "textDocument/rename",     "textDocument/documentSymbol"};
    if (std::ranges::find(kMethods, method) == std::end(kMethods))
      throw Failure{kUnknownMethod,
                    fmt::format("there is no method '{}'", text::printable(text::shortened(method)))};
    settle();  // answers are about the text as it is
    const std::shared_ptr<const Text> text = texts_.of(pathOf(parameters.at("textDocument")));
    if (method == "textDocument/documentSymbol") return text ? symbolsOf(*text) : nullptr;
    const Json& position = parameters.at("position");
    if (!text && method == "textDocument/rename") throw Failure{kRequestFailed, "there is no such file"};
    if (!text) return nullptr;
    workspace_.readAll();
    const std::size_t offset = text->offsetOf(position);
    if (method == "textDocument/completion") return completionAt(workspace_, *text, offset);
    if (method == "textDocument/hover") return hoverAt(workspace_, *text, offset);
    if (method == "textDocument/rename") {
      std::string problem;
      Json edit = renameAt(workspace_, *text, offset, parameters.at("newName").get<std::string>(), problem);
      if (!problem.empty()) throw Failure{kRequestFailed, problem};
      return edit;
    }
    Json list = Json::array();
    for (const Location& each : method == "textDocument/definition"
                                    ? definitionsAt(workspace_, *text, offset)
                                    : usesAt(workspace_, *text, offset).locations)
      if (const auto file = texts_.of(each.path))
        list.push_back({{"uri", text::uriOf(each.path)}, {"range", file->toJson(each.range)}});
    return list;
  }

  Json initialize(const Json& parameters) {
    std::vector<std::string> folders;
    const auto add = [&](const Json& object, const char* key) {
      if (!object.is_object() || !object.contains(key) || !object[key].is_string()) return;
      std::string path = pathOfUri(object[key].get_ref<const std::string&>());
      while (path.size() > 1 && path.ends_with('/')) path.pop_back();
      if (!path.empty()) folders.push_back(std::move(path));
    };
    add(parameters, "rootUri");
    if (parameters.is_object() && parameters.contains("workspaceFolders"))
      for (const Json& each : parameters["workspaceFolders"]) add(each, "uri");
    workspace_.setFolders(std::move(folders));
    return {{"capabilities",
             {{"positionEncoding", "utf-16"},
              {"textDocumentSync", {{"openClose", true}, {"change", 1}}},
              {"completionProvider", {{"triggerCharacters", {"\"", "$", "@", ".", "(", "/"}}}},
              {"hoverProvider", true},
              {"definitionProvider", true},
              {"referencesProvider", true},
              {"renameProvider", true},
              {"documentSymbolProvider", true}}},
            {"serverInfo", {{"name", "weft"}, {"version", kVersion}}}};
  }

  void notify(const std::string& method, const Json& parameters) {
    if (method == "exit") {
      ended_ = shutDown_ ? 0 : 1;
      return;
    }
    const bool opens = method == "textDocument/didOpen", changes = method == "textDocument/didChange",
               closes = method == "textDocument/didClose";
    if (shutDown_ || (!opens && !changes && !closes)) return;
    const Json& document = parameters.at("textDocument");
    const std::string path = pathOf(document);
    changed_.insert(path);
    if (closes) return texts_.close(path);
    const std::int64_t version = document.value("version", std::int64_t{0});
    if (opens) return texts_.open(path, document.at("text").get<std::string>(), version);
    const Json& whole = parameters.at("contentChanges");
    if (texts_.isOpen(path) && !whole.empty())
      texts_.open(path, whole.back().at("text").get<std::string>(), version);
  }

  Texts texts_;
  Workspace workspace_;
  std::set<std::string> changed_;          // since the last settle()
  std::map<std::string, Json> published_;  // what the editor shows, by file
  bool shutDown_ = false;
  std::optional<int> ended_;
};

int runLsp(Options& options) {
  std::ios::sync_with_stdio(false);  // what has arrived is known only of streams with a buffer of their own
  Server server(options);
  try {
    while (!server.ended()) {
      if (std::cin.rdbuf()->in_avail() <= 0)
        server.settle();  // nobody waits for it before all changes are taken
      server.take(readMessage());
    }
  } catch (const Failure& end) {
    printError(fmt::format("weft lsp: {}; editors end the server by 'shutdown' and 'exit'\n", end.what));
    return 1;
  }
  return *server.ended();
}

}  // namespace

}  // namespace lsp

void addLsp(CommandLine& line) {
  const auto [command, options] =
      line.add("lsp", "language server for editors (docs/editors.md); needs no OpenGL", lsp::runLsp);
  addPath(command, "--scene", options.scene, "scene that graphs are checked with");
  options.addSize(command);
  command.add_flag("--stdio")->description("as always");
  command.footer("Example, for Neovim: vim.lsp.start({ name = 'weft', cmd = { 'weft', 'lsp' } })");
}

}  // namespace weft::app
