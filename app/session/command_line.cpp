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
  option.value = colon == std::string::npos || !option.choices.empty() ? "VALUE" : type.substr(colon + 1);
}

// What the words of a description say of the value, for shells: a file, a folder.
const char* kindOf(const OptionText& option) {
  const std::string& name = option.names.empty() ? option.value : option.names[0];
  if (option.value == "FOLDER" || name == "--program-cache") return "folder";
  for (const char* file : {"--scene", "--environment", "--materials", "--output", "--trace", "--screenshot",
                           "--record", "--preset", "--workload", "--frame", "--edit"})
    if (name == file) return "file";
  return option.names.empty() && option.value != "name" ? "file" : "";
}

std::string quotedForShell(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string namesOf(const CommandText& command) {
  std::string text;
  for (const OptionText& option : command.options)
    for (const std::string& name : option.names) text += (text.empty() ? "" : " ") + name;
  return text;
}

std::string bashScript(const std::vector<CommandText>& commands) {
  std::string names, options, values;
  for (const CommandText& command : commands) {
    names += (names.empty() ? "" : " ") + command.name;
    options += fmt::format("    {}) options={} ;;\n", command.name, quotedForShell(namesOf(command)));
    for (const OptionText& option : command.options) {
      if (option.names.empty() || option.value.empty()) continue;
      std::string patterns;
      for (const std::string& name : option.names)
        patterns += fmt::format("{}{}:{}", patterns.empty() ? "" : " | ", command.name, name);
      const std::string kind = kindOf(option);
      const std::string action =
          !option.choices.empty()
              ? fmt::format("words={}", quotedForShell(fmt::format("{}", fmt::join(option.choices, " "))))
          : kind == "file"   ? "files=yes"
          : kind == "folder" ? "folders=yes"
                             : "any=yes";
      values += fmt::format("    {}) {} ;;\n", patterns, action);
    }
  }
  return fmt::format(R"(# bash completion of weft, made by `weft completion bash`.
_weft() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}} command= options= words= files= folders= any= i
  # --option=value comes in three words.
  if [ "$current" = = ]; then current=; elif [ "$previous" = = ]; then previous=${{COMP_WORDS[COMP_CWORD-2]}}; fi
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case ${{COMP_WORDS[i]}} in -*) ;; *) command=${{COMP_WORDS[i]}}; break ;; esac
  done
  COMPREPLY=()
  if [ -z "$command" ]; then
    COMPREPLY=($(compgen -W {} -- "$current"))
    return
  fi
  case $command in
{}    *) return ;;
  esac
  case $command:$previous in
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
  else
    compopt -o filenames 2>/dev/null || true
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
  fi
}}
complete -F _weft weft
)",
                     quotedForShell(names + " --help --version"), options, values);
}

std::string withoutBrackets(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '[' || c == ']' || c == ':' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return out;
}

std::string zshScript(const std::vector<CommandText>& commands) {
  std::string list, cases;
  for (const CommandText& command : commands) {
    list += fmt::format("    {}\n",
                        quotedForShell(fmt::format("{}:{}", command.name, withoutBrackets(command.doc))));
    std::string specs;
    int position = 0;
    for (const OptionText& option : command.options) {
      const std::string kind = kindOf(option);
      const std::string action = !option.choices.empty() ? fmt::format("({})", fmt::join(option.choices, " "))
                                 : kind == "file"        ? "_files"
                                 : kind == "folder"      ? "_files -/"
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
                "{}{}[{}]{}", option.repeatable ? "*" : "", name, withoutBrackets(option.doc),
                option.value.empty()
                    ? ""
                    : fmt::format(":{}:{}", withoutBrackets(option.value), action.empty() ? " " : action))));
    }
    cases += fmt::format("      {}) _arguments{} ;;\n", command.name, specs);
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
      case $line[1] in
{}      esac ;;
  esac
}}
_weft "$@"
)",
                     list, cases);
}

std::string fishScript(const std::vector<CommandText>& commands) {
  std::string text = "# fish completion of weft, made by `weft completion fish`.\n";
  for (const CommandText& command : commands)
    text += fmt::format("complete -c weft -f -n __fish_use_subcommand -a {} -d {}\n", command.name,
                        quotedForShell(command.doc));
  for (const CommandText& command : commands)
    for (const OptionText& option : command.options) {
      if (option.names.empty()) continue;
      text += fmt::format("complete -c weft -n '__fish_seen_subcommand_from {}'", command.name);
      for (const std::string& name : option.names)
        text += name.starts_with("--") ? fmt::format(" -l {}", name.substr(2))
                                       : fmt::format(" -s {}", name.substr(1));
      const std::string kind = kindOf(option);
      if (!option.choices.empty())
        text += fmt::format(" -x -a {}", quotedForShell(fmt::format("{}", fmt::join(option.choices, " "))));
      else if (kind == "folder")
        text += " -x -a '(__fish_complete_directories)'";
      else if (!option.value.empty())
        text += kind == "file" ? " -r" : " -x";
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

std::vector<CommandText> describeCommands(const CLI::App& app) {
  std::vector<CommandText> commands;
  for (const CLI::App* each : app.get_subcommands([](const CLI::App*) { return true; })) {
    CommandText command{.name = each->get_name(),
                        .doc = each->get_description(),
                        .footer = each->get_footer(),
                        .options = {}};
    for (const CLI::Option* written : each->get_options()) {
      OptionText option{.names = {},
                        .value = {},
                        .choices = {},
                        .doc = written->get_description(),
                        .required = written->get_required()};
      for (const std::string& name : written->get_lnames()) option.names.push_back("--" + name);
      for (const std::string& name : written->get_snames()) option.names.push_back("-" + name);
      const bool takesValue = written->get_items_expected_max() > 0 && written->get_type_size_max() > 0;
      if (takesValue) readType(written->get_type_name(), option);
      option.repeatable = written->get_items_expected_max() > 1;
      if (option.names.empty()) option.value = written->get_name(true);
      if (option.value == "VALUE" && kindOf(option) == std::string_view("file")) option.value = "FILE";
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
      ".\\\" Made by `weft man`.\n.TH WEFT 1 \"\" \"weft {}\" \"User Commands\"\n.SH NAME\nweft \\- render "
      "graphs for OpenGL: a frame is a JSON file\n"
      ".SH SYNOPSIS\n.B weft\n.I COMMAND\n.RI [ ARGUMENT .\\|.\\|.]\n.SH DESCRIPTION\n"
      "Checks, compiles and runs frames that are described in JSON: textures and buffers, passes, and which "
      "pass reads and writes what.\n.SH COMMANDS\n",
      roff(kVersion));
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
