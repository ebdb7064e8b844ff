// weft lsp: the language server on standard input and output. Opens no context.
#pragma once

#include "app/session/options.h"

namespace weft::app {

// 0 after "shutdown" and "exit"; 1 when the input ended before, or is none of the protocol.
int runLsp(const Options& options);

}  // namespace weft::app
