#include "app/lsp/lsp.h"

#include <fmt/format.h>
#include <unistd.h>

#include "app/lsp/server.h"
#include "app/lsp/text/framing.h"
#include "app/output/standard_streams.h"

namespace weft::app {

int runLsp(const Options& options) {
  lsp::FrameReader reader(STDIN_FILENO);
  lsp::Server server(options, [](const lsp::Json& message) {
    print(lsp::framed(message.dump(-1, ' ', false, lsp::Json::error_handler_t::replace)));
    flushPrinted();
  });
  while (!server.ended()) {
    if (!reader.hasMore()) server.settle();
    const lsp::Incoming incoming = reader.next();
    if (incoming.state == lsp::Incoming::State::ended) {
      printError(fmt::format("weft lsp: {}; editors end the server by 'shutdown' and 'exit'\n",
                             incoming.text.empty() ? "the input ended without 'exit'" : incoming.text));
      return 1;
    }
    if (incoming.state == lsp::Incoming::State::broken)
      server.refuse(incoming.text);
    else
      server.take(incoming.text);
  }
  return *server.ended();
}

}  // namespace weft::app
