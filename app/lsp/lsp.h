// weft lsp: the language server on standard input and output. Opens no context.
#pragma once

#include "app/session/command_line.h"

namespace weft::app {

// Its exit code: 0 after "shutdown" and "exit"; 1 when the input ended before, or is none of the protocol.
void addLsp(CommandLine& line);

}  // namespace weft::app
