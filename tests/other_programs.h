// What a test executable is besides the tests, by its first argument: a process of its own that the engine starts.
#pragma once

#include <map>
#include <string>

namespace weft::test {

inline std::map<std::string, void (*)(int, char**)>& otherPrograms() {
  static std::map<std::string, void (*)(int, char**)> programs;
  return programs;
}

}  // namespace weft::test
