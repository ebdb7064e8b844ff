#include "app/session/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "app/session/options.h"

namespace weft::app {

namespace {

// "TEXT:{auto,osmesa}" holds choices, "TEXT:WxH" the name of a value.
void readType(const std::string& type, OptionText& option) {
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open != std::string::npos && close != std::string::npos)
    for (std::size_t at = open + 1; at < close;) {
      const std::size_t end = std::min(type.find(',', at), close);
      option.choices.push_back(type.substr(at, end - at));
      at = end + 1;
    }
  const std::size_t colon = type.find(':');
  const bool named =
      option.choices.empty() && (colon != std::string::npos || type == "FILE" || type == "FOLDER");
  option.value = !named ? "VALUE" : colon == std::string::npos ? type : type.substr(colon + 1);
  option.kind = option.value == "FILE" ? "file" : option.value == "FOLDER" ? "folder" : "";
}

bool isInner(const CommandText& command) {
  return command.name.find(' ') != std::string::npos;
}

std::string namesOf(const CommandText& command) {
  std::string text;
  for (const OptionText& option : command.options)
    for (const std::string& name : option.names) text += (text.empty() ? "" : " ") + name;
  return text;
}

std::string bashScript(const std::vector<CommandText>& commands) {
  std::string names, nested, options, values;
  for (const CommandText& command : commands) {
    const std::string quoted = quotedForShell(command.name);
    if (isInner(command))
      nested += fmt::format("        {}) command={} ;;\n", quoted, quoted);
    else
      names += (names.empty() ? "" : " ") + command.name;
    options += fmt::format("    {}) options={} inner={} ;;\n", quoted, quotedForShell(namesOf(command)),
                           quotedForShell(fmt::format("{}", fmt::join(command.inner, " "))));
    for (const OptionText& option : command.options) {
      if (option.names.empty() || option.value.empty()) continue;
      std::string patterns;
      for (const std::string& name : option.names)
        patterns +=
            fmt::format("{}{}", patterns.empty() ? "" : " | ", quotedForShell(command.name + ":" + name));
      const std::string action =
          !option.choices.empty()
              ? fmt::format("words={}", quotedForShell(fmt::format("{}", fmt::join(option.choices, " "))))
          : option.kind == "file"   ? "files=yes"
          : option.kind == "folder" ? "folders=yes"
                                    : "any=yes";
      values += fmt::format("    {}) {} ;;\n", patterns, action);
    }
  }
  return fmt::format(R"(# bash completion of weft, made by `weft completion bash`.
_weft() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}} command= options= inner= words= files= folders= any= i
  # --option=value comes in three words.
  if [ "$current" = = ]; then current=; elif [ "$previous" = = ]; then previous=${{COMP_WORDS[COMP_CWORD-2]}}; fi
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case ${{COMP_WORDS[i]}} in -*) continue ;; esac
    if [ -z "$command" ]; then
      command=${{COMP_WORDS[i]}}
    else
      case "$command ${{COMP_WORDS[i]}}" in
{}      esac
    fi
  done
  COMPREPLY=()
  if [ -z "$command" ]; then
    COMPREPLY=($(compgen -W {} -- "$current"))
    return
  fi
  case "$command" in
{}    *) return ;;
  esac
  case "$command:$previous" in
{}  esac
  if [ -n "$words" ]; then
    COMPREPLY=($(compgen -W "$words" -- "$current"))
  elif [ -n "$folders" ]; then
    compopt -o filenames 2>/dev/null || true
    mapfile -t COMPREPLY < <(compgen -d -- "$current")
  elif [ -n "$any" ]; then
    :
  elif [ -z "$files" ] && [ "${{current#-}}" != "$current" ]; then
    COMPREPLY=($(compgen -W "$options" -- "$current"))
  elif [ -z "$files" ] && [ -n "$inner" ]; then
    COMPREPLY=($(compgen -W "$inner" -- "$current"))
  else
    compopt -o filenames 2>/dev/null || true
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
  fi
}}
complete -F _weft weft
)",
                     nested, quotedForShell(names + " --help --version"), options, values);
}

std::string withoutBrackets(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '[' || c == ']' || c == ':' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return out;
}

std::string zshScript(const std::vector<CommandText>& commands) {
  std::string list, nested, cases;
  for (const CommandText& command : commands) {
    if (isInner(command))
      nested += fmt::format("          {0}) name={0}; shift words; (( --CURRENT )) ;;\n",
                            quotedForShell(command.name));
    else
      list += fmt::format("    {}\n",
                          quotedForShell(fmt::format("{}:{}", command.name, withoutBrackets(command.doc))));
    std::string specs;
    int position = 0;
    for (const OptionText& option : command.options) {
      const std::string action = !option.choices.empty() ? fmt::format("({})", fmt::join(option.choices, " "))
                                 : option.kind == "file" ? "_files"
                                 : option.kind == "folder" ? "_files -/"
                                                           : "";
      if (option.names.empty()) {
        specs += fmt::format(
            " \\\n        {}",
            quotedForShell(fmt::format("{}:{}:{}", option.repeatable ? "*" : std::to_string(++position),
                                       withoutBrackets(option.value), action.empty() ? " " : action)));
        continue;
      }
      for (const std::string& name : option.names)
        specs += fmt::format(
            " \\\n        {}",
            quotedForShell(fmt::format(
                "{}{}{}[{}]{}", option.repeatable ? "*" : "", name,
                name.starts_with("--") && !option.value.empty() ? "=" : "",  // or in the next word
                withoutBrackets(option.doc),
                option.value.empty()
                    ? ""
                    : fmt::format(":{}:{}", withoutBrackets(option.value), action.empty() ? " " : action))));
    }
    if (!command.inner.empty())
      specs += fmt::format(" \\\n        {}",
                           quotedForShell(fmt::format("1:command:({})", fmt::join(command.inner, " "))));
    cases += fmt::format("      {}) _arguments{} ;;\n", quotedForShell(command.name), specs);
  }
  return fmt::format(R"(#compdef weft
# zsh completion of weft, made by `weft completion zsh`.
_weft() {{
  local state line
  local -a commands
  commands=(
{}  )
  _arguments -C '--help[print help]' '--version[print the version]' '1:command:->command' '*::argument:->argument'
  case $state in
    command) _describe command commands ;;
    argument)
      local name=$line[1]
      # A command of a command: its words begin there.
      if (( CURRENT > 2 )); then
        case "$name $words[2]" in
{}        esac
      fi
      case $name in
{}      esac ;;
  esac
}}
_weft "$@"
)",
                     list, nested, cases);
}

std::string fishScript(const std::vector<CommandText>& commands) {
  std::string text =
      "# fish completion of weft, made by `weft completion fish`.\n"
      "complete -c weft -n __fish_use_subcommand -l help -s h -d 'print help'\n"
      "complete -c weft -n __fish_use_subcommand -l version -d 'print the version'\n";
  for (const CommandText& command : commands) {
    const std::size_t space = command.name.find(' ');
    const std::string outer = command.name.substr(0, space);
    const std::string name = isInner(command) ? command.name.substr(space + 1) : outer;
    const std::string condition =
        isInner(command)
            ? fmt::format("__fish_seen_subcommand_from {}; and not __fish_seen_subcommand_from {}", outer,
                          name)
            : "__fish_use_subcommand";
    text += fmt::format("complete -c weft -f -n {} -a {} -d {}\n", quotedForShell(condition), name,
                        quotedForShell(command.doc));
  }
  for (const CommandText& command : commands)
    for (const OptionText& option : command.options) {
      if (option.names.empty()) continue;
      std::string condition = "__fish_seen_subcommand_from " + command.name;
      if (const std::size_t space = condition.find(' ', condition.find(' ') + 1); space != std::string::npos)
        condition.replace(space, 1, "; and __fish_seen_subcommand_from ");
      text += fmt::format("complete -c weft -n {}", quotedForShell(condition));
      for (const std::string& name : option.names)
        text += name.starts_with("--") ? fmt::format(" -l {}", name.substr(2))
                                       : fmt::format(" -s {}", name.substr(1));
      if (!option.choices.empty())
        text += fmt::format(" -x -a {}", quotedForShell(fmt::format("{}", fmt::join(option.choices, " "))));
      else if (option.kind == "folder")
        text += " -x -a '(__fish_complete_directories)'";
      else if (!option.value.empty())
        text += option.kind == "file" ? " -r" : " -x";
      text += fmt::format(" -d {}\n", quotedForShell(option.doc));
    }
  return text;
}

// Text of a man page: no line begins with a control character, and a hyphen of an option is one.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out.starts_with('.') || out.starts_with('\'') ? "\\&" + out : out;
}

}  // namespace

std::string quotedForShell(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::vector<CLI::App*> allCommands(CLI::App& app) {
  std::vector<CLI::App*> commands;
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
    commands.push_back(command);
    const std::vector<CLI::App*> inner = allCommands(*command);
    commands.insert(commands.end(), inner.begin(), inner.end());
  }
  return commands;
}

std::vector<CommandText> describeCommands(CLI::App& app) {
  std::vector<CommandText> commands;
  for (CLI::App* each : allCommands(app)) {
    CommandText command{.name = each->get_name(),
                        .doc = each->get_description(),
                        .footer = each->get_footer(),
                        .options = {},
                        .inner = {}};
    if (each->get_parent() != &app) command.name = each->get_parent()->get_name() + " " + command.name;
    for (const CLI::App* inner : allCommands(*each)) command.inner.push_back(inner->get_name());
    for (const CLI::Option* written : each->get_options()) {
      OptionText option{.names = {},
                        .value = {},
                        .choices = {},
                        .kind = {},
                        .doc = written->get_description(),
                        .required = written->get_required()};
      for (const std::string& name : written->get_lnames()) option.names.push_back("--" + name);
      for (const std::string& name : written->get_snames()) option.names.push_back("-" + name);
      const bool takesValue = written->get_items_expected_max() > 0 && written->get_type_size_max() > 0;
      if (takesValue) readType(written->get_type_name(), option);
      option.repeatable = written->get_items_expected_max() > 1;
      if (option.names.empty()) option.value = written->get_name(true);
      command.options.push_back(std::move(option));
    }
    commands.push_back(std::move(command));
  }
  return commands;
}

std::string completionScript(const std::vector<CommandText>& commands, const std::string& shell) {
  return shell == "zsh" ? zshScript(commands) : shell == "fish" ? fishScript(commands) : bashScript(commands);
}

std::string manPage(const std::vector<CommandText>& commands) {
  std::string text = fmt::format(
      ".\\\" Made by `weft man`.\n.TH WEFT 1 \"{}\" \"weft {}\" \"User Commands\"\n.SH NAME\nweft \\- render "
      "graphs for OpenGL: a frame is a JSON file\n"
      ".SH SYNOPSIS\n.B weft\n.I COMMAND\n.RI [ ARGUMENT .\\|.\\|.]\n.SH DESCRIPTION\n"
      "Checks, compiles and runs frames that are described in JSON: textures and buffers, passes, and which "
      "pass reads and writes what.\n.SH COMMANDS\n",
      kReleased, roff(kVersion));
  for (const CommandText& command : commands) {
    text += fmt::format(".SS weft {}", roff(command.name));
    for (const OptionText& option : command.options)
      if (option.names.empty())
        text += fmt::format(" {}{}{}", option.required ? "" : "[", roff(option.value),
                            option.required ? "" : "]");
    text += "\n" + roff(command.doc) + ".\n";
    for (const OptionText& option : command.options) {
      text += ".TP\n";
      if (option.names.empty()) {
        text += fmt::format(".I {}\n", roff(option.value));
      } else {
        std::string names;
        for (const std::string& name : option.names)
          names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", roff(name));
        text += names + (option.value.empty() ? "" : fmt::format(" \\fI{}\\fR", roff(option.value))) + "\n";
      }
      text += roff(option.doc) +
              (option.choices.empty() ? "" : roff(fmt::format(": {}", fmt::join(option.choices, ", ")))) +
              ".\n";
    }
    if (!command.footer.empty()) text += ".PP\n" + roff(command.footer) + "\n";
  }
  return text +
         ".SH EXIT STATUS\n.TP\n.B 0\nDone; warnings do not count.\n.TP\n.B 1\nSomething is wrong with the "
         "input, or an output could not be written.\n"
         ".TP\n.B 2\nThe command line is wrong; of\n.BR diff :\na graph is.\n.TP\n.B 3\nThe machine cannot: "
         "there is no OpenGL context.\n"
         ".SH ENVIRONMENT\n.TP\n.B WEFT_DATA\nThe folder that holds graphs/, shaders/, scenes/ and "
         "materials/.\n";
}

}  // namespace weft::app
