#include "engine/glsl/source.h"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <algorithm>

#include "engine/text/files/file.h"
#include "tests/temporary_folder.h"

using namespace weft::glsl;
using weft::text::Code;
using weft::text::Diagnostic;
using weft::text::Diagnostics;
using weft::text::Severity;

namespace {

std::size_t occurrences(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

// The place of the line of the text that contains `what`.
std::pair<std::string, std::uint32_t> placeOf(const ShaderSource& source, const std::string& what) {
  const std::size_t at = source.text.find(what);
  if (at == std::string::npos) return {"", 0};
  const auto line = static_cast<std::uint32_t>(
      std::count(source.text.begin(), source.text.begin() + static_cast<long>(at), '\n'));
  const auto place = source.placeOf(line + 1);
  return {*place.file, place.line};
}

}  // namespace

TEST_CASE("includes are found beside the includer and below the roots, once each, with true lines") {
  TemporaryFolder folder;
  folder.write("common/a.glsl", "#pragma once\n#include \"deep/b.glsl\"\nfloat a() { return b(); }\n");
  folder.write("common/deep/b.glsl", "// first line\nfloat b() { return 1.0; }\n");
  folder.write("fx/x.frag.glsl",
               "#include \"common/a.glsl\"\n#include \"local.glsl\"\n#include \"common/deep/b.glsl\"\nvoid "
               "main() { a(); }\n");
  folder.write("fx/local.glsl", "float local_value;");  // no newline at the end
  SourceLoader loader({folder.path().string()});
  Diagnostics diagnostics;
  const auto source = loader.load("fx/x.frag.glsl", diagnostics);
  REQUIRE_MESSAGE(source, diagnostics.text());
  CHECK(diagnostics.empty());
  CHECK(occurrences(source->text, "float b()") == 1);
  CHECK(placeOf(*source, "float b()") == std::pair(folder.at("common/deep/b.glsl"), 2u));
  CHECK(placeOf(*source, "float a()") == std::pair(folder.at("common/a.glsl"), 3u));
  CHECK(placeOf(*source, "local_value") == std::pair(folder.at("fx/local.glsl"), 1u));
  CHECK(placeOf(*source, "void main") == std::pair(folder.at("fx/x.frag.glsl"), 4u));
  CHECK(*source->file == folder.at("fx/x.frag.glsl"));
}

TEST_CASE("a file included inside an #if is still there when it is included again") {
  TemporaryFolder folder;
  folder.write("v.glsl", "float v;\n");
  folder.write(
      "x.frag.glsl",
      "#ifdef A\n#include \"v.glsl\"\n#endif\n#include \"v.glsl\"\n#include \"v.glsl\"\nvoid main() {}\n");
  SourceLoader loader({folder.path().string()});
  Diagnostics diagnostics;
  const auto source = loader.load("x.frag.glsl", diagnostics);
  REQUIRE(source);
  CHECK(occurrences(source->text, "float v;") == 2);  // the third is superfluous
  CHECK(occurrences(source->text, "#ifndef WEFT_INCLUDED_1") == 2);
  CHECK(occurrences(source->text, "#define WEFT_INCLUDED_1") == 1);
}

TEST_CASE("a guard of a whole file is no condition of what it includes") {
  TemporaryFolder folder;
  folder.write("v.glsl", "float v;\n");
  folder.write("a.glsl", "// Says what.\n#ifndef A_GLSL\n#define A_GLSL\n#include \"v.glsl\"\n#endif\n");
  folder.write("b.glsl", "#ifndef B_GLSL\n#define B_GLSL\n#ifdef C\n#include \"w.glsl\"\n#endif\n#endif\n");
  folder.write("w.glsl", "float w;\n");
  // No guards: of another name, and not the first directive.
  folder.write("d.glsl", "#ifndef D\n#define E\n#include \"x.glsl\"\n#endif\n");
  folder.write("e.glsl", "#define F\n#ifndef G\n#define G\n#include \"y.glsl\"\n#endif\n");
  folder.write("x.glsl", "float x;\n");
  folder.write("y.glsl", "float y;\n");
  // Behind the #else of a guard stands what is not always there.
  folder.write("f.glsl", "#ifndef H\n#define H\n#else\n#include \"z.glsl\"\n#endif\n");
  folder.write("z.glsl", "float z;\n");
  std::string text;
  for (const char* name : {"a", "b", "d", "e", "f", "v", "w", "x", "y", "z"})
    text += "#include \"" + std::string(name) + ".glsl\"\n";
  folder.write("x.frag.glsl", text + "void main() {}\n");
  SourceLoader loader({folder.path().string()});
  Diagnostics diagnostics;
  const auto source = loader.load("x.frag.glsl", diagnostics);
  REQUIRE_MESSAGE(source, diagnostics.text());
  CHECK(occurrences(source->text, "float v;") == 1);
  for (const char* name : {"w", "x", "y", "z"})
    CHECK_MESSAGE(occurrences(source->text, "float " + std::string(name) + ";") == 2, name);
}

TEST_CASE("cycles are reported with their path, once, at the include that closes them") {
  TemporaryFolder folder;
  folder.write("a.glsl", "#include \"b.glsl\"\n");
  folder.write("b.glsl", "\n\n  #include \"a.glsl\"\n");
  folder.write("x.frag.glsl", "#include \"a.glsl\"\nvoid main() {}\n");
  SourceLoader loader({folder.path().string()});
  Diagnostics diagnostics;
  CHECK_FALSE(loader.load("x.frag.glsl", diagnostics));
  REQUIRE(diagnostics.size() == 1);
  const Diagnostic& cycle = diagnostics.items()[0];
  CHECK(cycle.code == Code::shaderIncludeCycle);
  CHECK(*cycle.place.file == folder.at("b.glsl"));
  CHECK(cycle.place.line == 3);
  CHECK(cycle.place.column == 3);
  const std::string chain = folder.at("a.glsl") + " -> " + folder.at("b.glsl") + " -> " + folder.at("a.glsl");
  CHECK(cycle.message.find(chain) != std::string::npos);
  folder.write("self.frag.glsl", "#include \"self.frag.glsl\"\n");
  Diagnostics itself;
  CHECK_FALSE(loader.load("self.frag.glsl", itself));
  CHECK(itself.contains(Code::shaderIncludeCycle));
}

TEST_CASE("everything wrong with the directives is reported at once, with places and the nearest file") {
  TemporaryFolder folder;
  folder.write("common/view.glsl", "");
  folder.write(
      "x.frag.glsl",
      "#version 330\n#include \"common/veiw.glsl\"\n#include <common/view.glsl>\n// #include \"no.glsl\"\n"
      "/*\n#include \"no.glsl\"\n*/\n#include\nvoid main() {}\n");
  SourceLoader loader({folder.path().string()});
  Diagnostics diagnostics;
  CHECK_FALSE(loader.load("x.frag.glsl", diagnostics));
  REQUIRE_MESSAGE(diagnostics.size() == 4, diagnostics.text());
  const auto& items = diagnostics.items();
  CHECK(items[0].code == Code::versionInShader);
  CHECK(items[0].place.line == 1);
  CHECK(items[1].code == Code::missingShaderInclude);
  CHECK(items[1].place.line == 2);
  CHECK(items[1].hint == "did you mean 'common/view.glsl'?");
  CHECK(items[2].code == Code::malformedInclude);
  CHECK(items[2].place.line == 3);
  CHECK(items[3].code == Code::malformedInclude);
  CHECK(items[3].place.line == 8);
}

TEST_CASE("a missing shader is reported at the one who named it, a directory as a directory") {
  TemporaryFolder folder;
  folder.write("sky/sky.frag.glsl", "void main() {}\n");
  SourceLoader loader({folder.path().string()});
  Diagnostics diagnostics;
  const weft::text::Place graph{"studio.json", 12, 40};
  CHECK_FALSE(loader.load("sky/skye.frag.glsl", diagnostics, graph));
  CHECK_FALSE(loader.load("sky", diagnostics, graph));
  CHECK_FALSE(loader.load("project/sky/sky.frag.glsl", diagnostics, graph));
  CHECK_FALSE(loader.load("void main() { discard; }", diagnostics, graph));
  CHECK_FALSE(loader.load("far/up.frag.glsl", diagnostics, graph));
  REQUIRE(diagnostics.size() == 5);
  CHECK(diagnostics.items()[4].hint.empty());  // all shaders end alike
  CHECK(diagnostics.items()[2].hint == "did you mean 'sky/sky.frag.glsl'?");
  CHECK(diagnostics.items()[0].code == Code::unreadableShader);
  CHECK(*diagnostics.items()[0].place.file == "studio.json");
  CHECK(diagnostics.items()[0].place.line == 12);
  CHECK(diagnostics.items()[0].hint == "did you mean 'sky/sky.frag.glsl'?");
  CHECK(diagnostics.items()[1].message.find("directory") != std::string::npos);
}

TEST_CASE("an empty shader is reported as that, where it is") {
  TemporaryFolder folder;
  folder.write("empty.frag.glsl", " \n\n");
  SourceLoader loader({folder.path().string()});
  Diagnostics diagnostics;
  CHECK_FALSE(loader.load("empty.frag.glsl", diagnostics));
  REQUIRE(diagnostics.size() == 1);
  CHECK(diagnostics.items()[0].code == Code::shaderDoesNotCompile);
  CHECK(diagnostics.items()[0].message == "shader 'empty.frag.glsl' is empty");
  CHECK(diagnostics.items()[0].place.line == 1);
  folder.write("empty.frag.glsl", "void main() {}\n");
  CHECK(loader.load("empty.frag.glsl", diagnostics));
}

TEST_CASE("a shader's path leads where it says, until reading is confined") {
  TemporaryFolder folder;
  folder.write("secret.glsl", "float secret;\n");
  folder.write("x/shaders/a.frag.glsl", "void main() {}\n");
  folder.write("x/shaders/up.frag.glsl", "#include \"../../secret.glsl\"\nvoid main() {}\n");
  folder.write("x/shaders/gone.frag.glsl", "#include \"../../gone.glsl\"\nvoid main() {}\n");
  SourceLoader loader({folder.at("x/shaders")});
  Diagnostics diagnostics;
  for (const std::string& path :
       {std::string("./a.frag.glsl"), std::string("sky/../a.frag.glsl"), std::string("../../secret.glsl"),
        folder.at("secret.glsl"), std::string("up.frag.glsl")})
    CHECK_MESSAGE(loader.load(path, diagnostics), diagnostics.text());
  CHECK_FALSE(loader.load("../../gone.glsl", diagnostics));
  CHECK(diagnostics.items()[0].code == Code::unreadableShader);
  diagnostics.clear();

  loader.clear();
  REQUIRE_FALSE(weft::text::confineTo(folder.at("x")));
  CHECK(loader.load("a.frag.glsl", diagnostics));
  const std::pair<std::string, std::string> outside[] = {
      {"../../secret.glsl", "secret.glsl"},      {"../../gone.glsl", "gone.glsl"},
      {folder.at("secret.glsl"), "secret.glsl"}, {folder.at("gone.glsl"), "gone.glsl"},
      {"up.frag.glsl", "secret.glsl"},           {"gone.frag.glsl", "gone.glsl"}};
  for (const auto& [path, told] : outside) {
    CHECK_FALSE(loader.load(path, diagnostics));
    REQUIRE_MESSAGE(diagnostics.size() == 1, diagnostics.text());
    CHECK(diagnostics.items()[0].code == Code::outsideConfinement);
    CHECK(diagnostics.items()[0].message.starts_with("'" + folder.at(told.c_str()) + "'"));
    diagnostics.clear();
  }
  CHECK_FALSE(loader.load("gon.frag.glsl", diagnostics));
  CHECK(diagnostics.items()[0].code == Code::unreadableShader);
  CHECK(diagnostics.items()[0].hint == "did you mean 'gone.frag.glsl'?");
  weft::text::resetFileAccess();
}

TEST_CASE("a shader that is a pipe is refused") {
  TemporaryFolder folder;
  REQUIRE(::mkfifo(folder.at("pipe.frag.glsl").c_str(), 0600) == 0);
  SourceLoader loader({folder.path().string()});
  Diagnostics diagnostics;
  CHECK_FALSE(loader.load("pipe.frag.glsl", diagnostics));
  REQUIRE(diagnostics.size() == 1);
  CHECK(diagnostics.items()[0].message.find("it is a pipe") != std::string::npos);
}

TEST_CASE("an unchanged file is expanded once, a changed include again") {
  TemporaryFolder folder;
  folder.write("a.glsl", "float one;\n");
  folder.write("x.frag.glsl", "#include \"a.glsl\"\nvoid main() {}\n");
  SourceLoader loader({folder.path().string()});
  Diagnostics diagnostics;
  const auto first = loader.load("x.frag.glsl", diagnostics);
  CHECK(loader.load("x.frag.glsl", diagnostics) == first);
  folder.write("a.glsl", "float two;\n");  // same size, other time
  const auto second = loader.load("x.frag.glsl", diagnostics);
  REQUIRE(second);
  CHECK(loader.load("x.frag.glsl", diagnostics) == second);
  CHECK(second->hash != first->hash);
  CHECK(second->text.find("two") != std::string::npos);
  folder.write("a.glsl", "#include \"gone.glsl\"\n");
  CHECK_FALSE(loader.load("x.frag.glsl", diagnostics));
  CHECK_FALSE(loader.load("x.frag.glsl", diagnostics));  // failures are not remembered: the file may appear
  folder.write("gone.glsl", "float three;\n");
  diagnostics.clear();
  CHECK(loader.load("x.frag.glsl", diagnostics));
  CHECK(diagnostics.empty());
}

TEST_CASE("what was read, and what was looked for in vain, is what to watch") {
  TemporaryFolder folder;
  folder.write("x/a.glsl", "#include \"b.glsl\"\n");
  folder.write("x/b.glsl", "float b;\n");
  folder.write("x/wants.glsl", "#include \"b.glsl\"\n#include \"late.glsl\"\n");
  const std::string root = folder.path().string(), other = folder.at("other");
  SourceLoader loader({root, other});
  Diagnostics diagnostics;
  using Paths = std::set<std::string>;
  const Paths both{root + "/x/a.glsl", root + "/x/b.glsl"};
  for (int i = 0; i < 2; ++i) {  // the second time from the cache
    loader.forgetTouched();
    REQUIRE(loader.load("x/a.glsl", diagnostics));
    CHECK(loader.touched() == both);
  }
  loader.forgetTouched();
  CHECK_FALSE(loader.load("x/wants.glsl", diagnostics));
  CHECK(loader.touched() == Paths{root + "/x/wants.glsl", root + "/x/b.glsl", root + "/x/late.glsl",
                                  root + "/late.glsl", other + "/late.glsl", other + "/x/late.glsl"});
  loader.forgetTouched();
  CHECK_FALSE(loader.load("y/none.glsl", diagnostics));
  CHECK(loader.touched() == Paths{root + "/y/none.glsl", other + "/y/none.glsl"});
}

TEST_CASE("a shader that is too large is not read, and is watched until it is smaller") {
  TemporaryFolder folder;
  folder.write("x/a.glsl", "float a;\n");
  folder.write("x/includes.glsl", "#include \"large.glsl\"\n");
  for (const char* name : {"x/large.glsl", "x/large.frag.glsl"}) {
    folder.write(name, "void main() {}\n");
    std::filesystem::resize_file(folder.at(name), (std::uintmax_t{16} << 20) + 1);
  }
  SourceLoader loader({folder.path().string()});
  Diagnostics diagnostics;
  CHECK_FALSE(loader.load("x/large.frag.glsl", diagnostics));
  REQUIRE(diagnostics.size() == 1);
  const Diagnostic& large = diagnostics.items()[0];
  CHECK(large.code == Code::shaderTooLarge);
  CHECK(*large.place.file == folder.at("x/large.frag.glsl"));
  CHECK(large.expected == "at most 1048576 bytes of one shader with what it includes");
  CHECK(large.found == "16777217");
  CHECK(large.hint.ends_with("raise the limits with --limit 2, if that is meant"));
  CHECK(loader.touched() == std::set{folder.at("x/large.frag.glsl")});

  diagnostics.clear();
  loader.forgetTouched();
  CHECK_FALSE(loader.load("x/includes.glsl", diagnostics));
  REQUIRE(diagnostics.size() == 1);
  CHECK(diagnostics.items()[0].message == "includes expand to more than 16 MiB");
  CHECK(diagnostics.items()[0].found == "'" + folder.at("x/large.glsl") + "' of 16777217 bytes");
  CHECK(*diagnostics.items()[0].place.file == folder.at("x/includes.glsl"));
  CHECK(diagnostics.items()[0].place.line == 1);
  CHECK(loader.touched() == std::set{folder.at("x/includes.glsl"), folder.at("x/large.glsl")});

  diagnostics.clear();
  folder.write("x/large.glsl", "float b;\n");
  CHECK(loader.load("x/includes.glsl", diagnostics));
  CHECK_MESSAGE(diagnostics.empty(), diagnostics.text());
}

TEST_CASE("text in memory includes from the roots only, and the prefix holds version and defines in order") {
  TemporaryFolder folder;
  folder.write("a.glsl", "float a;\n");
  SourceLoader loader({folder.path().string()});
  Diagnostics diagnostics;
  const auto source =
      loader.loadText("#include \"a.glsl\"\nvoid main() {}\n", "<fullscreen.vert>", diagnostics);
  REQUIRE(source);
  CHECK(loader.loadText("#include \"a.glsl\"\nvoid main() {}\n", "<fullscreen.vert>", diagnostics) == source);
  const Define defines[] = {{"HAS_BLOOM", "1"}, {"CURVE", "2"}};
  CHECK(assembleSource(*source, defines)
            .starts_with("#version 450 core\n#define HAS_BLOOM 1\n#define CURVE 2\n#line 10001\nfloat a;\n"));
}

TEST_CASE("indices of what a work group shares stay within its arrays") {
  const auto clamped = [](const std::string& statement) {
    const std::string before =
        "struct S { float list[4]; };\n#define ALIAS table\n#define AT(i) table[i]\nlayout(shared) uniform B "
        "{ float other[4]; };\n"
        "shared float table[64], more[4];\nshared S records[8];\nvoid main() { float own[3];\n";
    const std::string text = clampShared(before + statement + "\n}\n");
    return text.substr(text.find("own[3];\n") + 8, text.rfind("\n}") - text.find("own[3];\n") - 8);
  };
  CHECK(clamped("x = table[i + 1];") == "x = table[min(uint(i + 1), uint(table.length()) - 1u)];");
  CHECK(clamped("x = ALIAS[i];") == "x = ALIAS[min(uint(i), uint(ALIAS.length()) - 1u)];");
  CHECK(clamped("x = (table)[i];") == "x = (table)[min(uint(i), uint((table).length()) - 1u)];");
  CHECK(clamped("more[table[i]]++;") ==
        "more[min(uint(table[min(uint(i), uint(table.length()) - 1u)]), uint(more.length()) - 1u)]++;");
  CHECK(clamped("x = records[i].list[j];") ==
        "x = records[min(uint(i), uint(records.length()) - 1u)].list[min(uint(j), "
        "uint(records[0].list.length()) - 1u)];");
  CHECK(clamped("if (a) return table[i]; else table[i] = 1.0;")
            .find("uint(i), uint(table.length()) - 1u)]; else table[min(") != std::string::npos);
  for (const char* same :
       {"x = other[i] + own[j] + table[3] + b.table + AT(3);", "float table[n];", "float[2] more[n];"})
    CHECK(clamped(same) == same);
  CHECK(clampShared("#define T table\nshared float table[4];\n#define AT(i) T[i]\n").find("T[min(uint(i)") !=
        std::string::npos);
  for (const char* text : {"", "[", "shared", "shared float a[", "shared float a[4]; a[", "a]",
                           "shared float a[4]; ][x", "shared uint a[n], b[n], c[n][m + 1];"})
    CHECK(clampShared(text) == text);
}
