#include "app/lsp/server.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "app/lsp/answers/features.h"
#include "app/session/options.h"
#include "engine/text/chars.h"
#include "engine/text/printable.h"

namespace weft::app::lsp {

namespace {

// Error codes of the protocol.
constexpr int kParseError = -32700, kInvalidRequest = -32600, kUnknownMethod = -32601,
              kInvalidParameters = -32602, kInternalError = -32603, kNotInitialized = -32002,
              kRequestFailed = -32803;

// Thrown where a message cannot be answered; caught where it is.
struct Failure {
  int code;
  std::string what;
};

[[noreturn]] void failBy(std::string what) {
  throw Failure{kInvalidParameters, std::move(what)};
}

const Json& member(const Json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (!object.is_object() || found == object.end())
    failBy(fmt::format("expected \"{}\", found nothing", key));
  return *found;
}

const std::string& textOf(const Json& object, const char* key) {
  const Json& value = member(object, key);
  if (!value.is_string()) failBy(fmt::format("\"{}\": expected a string, found {}", key, value.type_name()));
  return value.get_ref<const std::string&>();
}

std::uint32_t numberOf(const Json& object, const char* key) {
  const Json& value = member(object, key);
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > 0x7fffffff)
    failBy(fmt::format("\"{}\": expected a whole number from 0 to 2147483647", key));
  return value.get<std::uint32_t>();
}

Position positionOf(const Json& position) {
  return {numberOf(position, "line"), numberOf(position, "character")};
}

std::string pathOf(const Json& parameters) {
  const std::string& uri = textOf(member(parameters, "textDocument"), "uri");
  const std::string path = pathOfUri(uri);
  if (path.empty())
    failBy(fmt::format("expected a file: URI, found '{}'", text::printable(text::shortened(uri))));
  return path;
}

constexpr int kMaxDepth = 500;  // of brackets in a message; the code that reads and copies JSON recurses

}  // namespace

void Server::fail(const Json& id, int code, const std::string& message) {
  send_({{"jsonrpc", "2.0"}, {"id", id}, {"error", {{"code", code}, {"message", message}}}});
}

void Server::refuse(const std::string& problem) {
  fail(nullptr, kParseError, problem);
}

void Server::take(std::string_view text) {
  bool deep = false;
  const auto look = [&](int depth, Json::parse_event_t, Json&) {
    deep = deep || depth > kMaxDepth;
    return !deep;
  };
  const Json message = Json::parse(text, look, false);
  if (deep) return refuse(fmt::format("a message with more than {} brackets around one another", kMaxDepth));
  if (message.is_discarded()) return refuse("the message is no JSON");
  if (!message.is_object()) return fail(nullptr, kInvalidRequest, "a message is an object");
  const auto id = message.find("id");
  const bool asks = id != message.end();
  if (asks && !id->is_string() && !id->is_number_integer())
    return fail(nullptr, kInvalidRequest, "\"id\": expected a string or a whole number");
  const auto method = message.find("method");
  if (method == message.end() && asks && (message.contains("result") || message.contains("error")))
    return;  // an answer to us
  if (method == message.end() || !method->is_string())
    return fail(asks ? *id : Json(nullptr), kInvalidRequest, "\"method\": expected a string");
  const auto found = message.find("params");
  static const Json kNothing = Json::object();
  const Json& parameters = found == message.end() ? kNothing : *found;
  const std::string& name = method->get_ref<const std::string&>();
  try {
    if (asks)
      request(*id, name, parameters);
    else
      notify(name, parameters);
  } catch (const Failure& failure) {
    if (asks) fail(*id, failure.code, failure.what);
  } catch (const std::exception& thrown) {  // a library threw: that ends an answer, not the server
    if (asks) fail(*id, kInternalError, thrown.what());
  }
}

void Server::request(const Json& id, const std::string& method, const Json& parameters) {
  if (shutDown_) return fail(id, kInvalidRequest, "the server was shut down");
  if (!initialized_ && method != "initialize") return fail(id, kNotInitialized, "\"initialize\" comes first");
  if (method == "initialize" && initialized_) return fail(id, kInvalidRequest, "\"initialize\" comes once");
  send_({{"jsonrpc", "2.0"}, {"id", id}, {"result", answer(method, parameters)}});
}

Json Server::answer(const std::string& method, const Json& parameters) {
  if (method == "initialize") return initialize(parameters);
  if (method == "shutdown") {
    shutDown_ = true;
    return nullptr;
  }
  constexpr std::string_view kMethods[] = {"completion",    "hover",  "definition",    "references",
                                           "prepareRename", "rename", "documentSymbol"};
  constexpr std::string_view kDocument = "textDocument/";
  const std::string_view what = std::string_view(method).substr(std::min(kDocument.size(), method.size()));
  if (!method.starts_with(kDocument) || std::ranges::find(kMethods, what) == std::end(kMethods))
    throw Failure{kUnknownMethod,
                  fmt::format("there is no method '{}'", text::printable(text::shortened(method)))};
  const bool here = what != "documentSymbol";
  settle();  // answers are about the text as it is
  const std::shared_ptr<const Text> text = texts_.of(pathOf(parameters));
  const Position position = here ? positionOf(member(parameters, "position")) : Position{};
  if (!text && what == "rename") throw Failure{kRequestFailed, "there is no such file"};
  if (!text) return nullptr;
  if (!here) return symbolsOf(*text);
  workspace_.readAll();
  const std::size_t offset = text->map().offsetOf(position);
  if (what == "completion") return completionAt(workspace_, *text, offset);
  if (what == "hover") return hoverAt(workspace_, *text, offset);
  const auto locations = [&](const auto& all) {
    Json list = Json::array();
    for (const Location& each : all)
      if (const auto file = texts_.of(each.path))
        list.push_back({{"uri", uriOfPath(each.path)}, {"range", lsp::toJson(file->map(), each.range)}});
    return list;
  };
  if (what == "definition") return locations(definitionsAt(workspace_, *text, offset));
  if (what == "rename") {
    Renamed renamed = renameAt(workspace_, *text, offset, textOf(parameters, "newName"));
    if (!renamed.problem.empty()) throw Failure{kRequestFailed, renamed.problem};
    return std::move(renamed.edit);
  }
  const Uses uses = usesAt(workspace_, *text, offset);
  if (what == "references") return locations(uses.locations);
  if (!uses.found) return nullptr;
  return {{"range", lsp::toJson(text->map(), uses.here)}, {"placeholder", uses.name}};
}

Json Server::initialize(const Json& parameters) {
  std::vector<std::string> folders;
  const auto add = [&](const Json& uri) {
    if (!uri.is_string()) return;
    if (std::string path = pathOfUri(uri.get_ref<const std::string&>()); !path.empty()) {
      while (path.size() > 1 && path.back() == '/') path.pop_back();
      folders.push_back(std::move(path));
    }
  };
  if (const auto all = parameters.find("workspaceFolders");
      parameters.is_object() && all != parameters.end() && all->is_array()) {
    for (const Json& each : *all)
      if (each.is_object() && each.contains("uri")) add(each["uri"]);
  } else if (const auto root = parameters.find("rootUri");
             parameters.is_object() && root != parameters.end()) {
    add(*root);
  }
  workspace_.setFolders(std::move(folders));
  initialized_ = true;
  Json signs = Json::array({"\"", "$", "@", ".", "(", "/"});
  return {{"capabilities",
           {{"positionEncoding", "utf-16"},
            {"textDocumentSync", {{"openClose", true}, {"change", 2}}},
            {"completionProvider", {{"triggerCharacters", std::move(signs)}}},
            {"hoverProvider", true},
            {"definitionProvider", true},
            {"referencesProvider", true},
            {"renameProvider", {{"prepareProvider", true}}},
            {"documentSymbolProvider", true}}},
          {"serverInfo", {{"name", "weft"}, {"version", kVersion}}}};
}

void Server::notify(const std::string& method, const Json& parameters) {
  if (method == "exit") {
    ended_ = shutDown_ ? 0 : 1;
    return;
  }
  if (!initialized_ || shutDown_) return;
  if (method == "textDocument/didOpen") {
    const Json& document = member(parameters, "textDocument");
    const std::string path = pathOf(parameters);
    const std::int64_t version = document.contains("version") && document["version"].is_number_integer()
                                     ? document["version"].get<std::int64_t>()
                                     : 0;
    texts_.open(path, textOf(document, "text"), version);
    changed_.insert(path);
  } else if (method == "textDocument/didChange") {
    change(parameters);
  } else if (method == "textDocument/didClose") {
    const std::string path = pathOf(parameters);
    texts_.close(path);
    changed_.insert(path);
  } else if (method == "workspace/didChangeWatchedFiles") {
    const Json& changes = member(parameters, "changes");
    if (!changes.is_array()) failBy("\"changes\": expected an array");
    for (const Json& each : changes)
      if (const std::string path = pathOfUri(textOf(each, "uri")); !path.empty()) changed_.insert(path);
  }
}

void Server::change(const Json& parameters) {
  const std::string path = pathOf(parameters);
  const Json& document = member(parameters, "textDocument");
  if (document.contains("version") && document["version"].is_number_integer())
    texts_.setVersion(path, document["version"].get<std::int64_t>());
  const Json& changes = member(parameters, "contentChanges");
  if (!changes.is_array()) failBy("\"contentChanges\": expected an array");
  for (const Json& each : changes) {
    if (each.is_object() && each.contains("range"))
      texts_.change(path, positionOf(member(each["range"], "start")),
                    positionOf(member(each["range"], "end")), textOf(each, "text"));
    else
      texts_.replace(path, textOf(each, "text"));
  }
  changed_.insert(path);
}

void Server::settle() {
  if (changed_.empty()) return;
  const std::set<std::string> touched = workspace_.refresh(std::exchange(changed_, {}));
  for (const std::string& path : touched) publish(path);
}

void Server::publish(const std::string& path) {
  const std::vector<text::Diagnostic> said = workspace_.diagnosticsOf(path);
  const bool shown = published_.contains(path);
  if (said.empty() && !shown && !texts_.isOpen(path)) return;
  const std::shared_ptr<const Text> text = texts_.of(path);
  Json list = Json::array();
  const Text nothing(path, "");
  for (const text::Diagnostic& each : said) list.push_back(toJson(each, text ? *text : nothing));
  if (said.empty())
    published_.erase(path);
  else
    published_.insert(path);
  Json parameters{{"uri", uriOfPath(path)}};
  if (const auto opened = texts_.opened().find(path); opened != texts_.opened().end())
    parameters["version"] = opened->second;
  parameters["diagnostics"] = std::move(list);
  send_(
      {{"jsonrpc", "2.0"}, {"method", "textDocument/publishDiagnostics"}, {"params", std::move(parameters)}});
}

Json Server::toJson(const text::Diagnostic& d, const Text& text) const {
  const std::string_view all = text.bytes();
  Range range;
  range.begin = range.end = d.place.line > 0 ? text::offsetOf(all, d.place.inFile()) : 0;
  // The range grows to the end of the word or the string there.
  if (range.end < all.size() && all[range.end] == '"') {
    do range.end += all[range.end] == '\\' ? 2 : 1;
    while (range.end < all.size() && all[range.end] != '"' && all[range.end] != '\n');
    range.end = std::min(range.end + (range.end < all.size() && all[range.end] == '"' ? 1 : 0), all.size());
  } else {
    while (range.end < all.size() && (text::isIdentChar(all[range.end]) || all[range.end] == '.'))
      ++range.end;
    if (range.end == range.begin && range.end < all.size() && all[range.end] != '\n') ++range.end;
  }
  std::string message = d.message;
  using Line = std::pair<const char*, const std::string&>;
  for (const auto& [label, said] : {Line{"expected", d.expected}, {"found", d.found}, {"fix", d.hint}})
    if (!said.empty()) message += fmt::format("\n{}: {}", label, text::shortened(said));
  const int severity = 3 - static_cast<int>(d.severity);
  return {{"range", lsp::toJson(text.map(), range)},
          {"severity", severity},
          {"code", text::nameOf(d.code)},
          {"source", "weft"},
          {"message", std::move(message)}};
}

}  // namespace weft::app::lsp
