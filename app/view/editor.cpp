#include "app/view/editor.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <utility>

namespace weft::app {

Editor::Editor(std::string command) : command_(std::move(command)) {
  for (const char* variable : {"VISUAL", "EDITOR"})
    if (const char* program = std::getenv(variable); program && command_.empty()) command_ = program;
}

std::string Editor::open(const text::Place& place) {
  if (!place.file) return "nothing is selected that is written in a file";
  if (command_.empty())
    return "no editor is known: set VISUAL or EDITOR, or start with --editor 'code -g {file}:{line}'";
  // The shell gets file and line as parameters, so that no name is taken for a command.
  std::string script = command_;
  const auto replace = [&](std::string_view word, std::string_view by) {
    bool found = false;
    for (std::size_t i = 0; (i = script.find(word, i)) != std::string::npos; i += by.size(), found = true)
      script.replace(i, word.size(), by);
    return found;
  };
  const bool named = replace("{file}", "\"$1\"");
  if (!replace("{line}", "\"$2\"") && !named) script += " +\"$2\"";
  if (!named) script += " \"$1\"";
  std::string file(*place.file), line = std::to_string(place.line), shell = "sh", option = "-c";
  char* const arguments[] = {shell.data(), option.data(), script.data(), shell.data(),
                             file.data(),  line.data(),   nullptr};
  // Not by text::startProcess(): an editor that runs in the terminal of this program must not lose it.
  pid_t process = 0;
  if (const int error = ::posix_spawn(&process, "/bin/sh", nullptr, nullptr, arguments, environ))
    return fmt::format("the editor was not started: {}", std::strerror(error));
  running_.push_back(process);
  return fmt::format("{}:{} is in the editor", file, line);
}

std::string Editor::takeFailure() {
  std::string failure;
  std::erase_if(running_, [&](pid_t process) {
    int status = 0;
    if (::waitpid(process, &status, WNOHANG) == 0) return false;
    if (status != 0)
      failure = fmt::format("the editor ({}) ended with {} {}", command_,
                            WIFEXITED(status) ? "exit code" : "signal",
                            WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status));
    return true;
  });
  return failure;
}

}  // namespace weft::app
