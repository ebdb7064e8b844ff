// The parts of the viewer that need no window: keys, clock, rest.
#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "app/ui/log.h"
#include "app/ui/pass_rows.h"
#include "app/view/frame_clock.h"
#include "app/view/key_bindings.h"

namespace weft::app {
namespace {

// What is listed, as a Markdown table.
std::string keyTable() {
  std::string text = "| input | does |\n|---|---|\n";
  for (const auto& [keys, help] : KeyTable().help()) {
    const char* quote = keys.ends_with("drag") || keys == "wheel" ? "" : "`";
    text += std::string("| ") + quote + keys + quote + " | " + help + " |\n";
  }
  return text;
}

TEST_CASE("docs/viewer.md has the table of keys as it is") {
  std::ifstream file(WEFT_SOURCE_DIR "/docs/viewer.md");
  std::stringstream text;
  text << file.rdbuf();
  REQUIRE(!text.str().empty());
  CHECK_MESSAGE(text.str().find(keyTable()) != std::string::npos, "it should hold:\n" << keyTable());
}

TEST_CASE("no key has two meanings, and each is found") {
  const KeyTable keys;
  text::Diagnostics said;
  KeyTable().add(kKeys, "again.json",
                 said);  // by the rules for a person's file, which has actions on keys alone
  CHECK(said.errorCount() == 14);
  std::set<std::pair<int, WithKey>> pressed;
  for (const KeyBinding& row : keys.rows()) {
    CAPTURE(row.keys);
    CHECK(!row.help.empty());
    if (row.verb.empty()) continue;
    CHECK(row.key != 0);
    CHECK(pressed.insert({row.key, row.with}).second);
    CHECK(keys.find(row.key, row.with) == &row);
  }
  CHECK(keys.find('9', WithKey::nothing)->name == "camera_9");
  CHECK(keys.find('F', WithKey::shift)->name == "fly");
  CHECK(keys.find('F', WithKey::control) == nullptr);
  CHECK(keys.find('W', WithKey::nothing) == nullptr);
  CHECK(keys.find(-1, WithKey::nothing) == nullptr);
}

TEST_CASE("a person's file of keys goes over Weft's; each mistake has its place") {
  KeyTable keys;
  text::Diagnostics said;
  keys.add(R"({ // mine
  "F": null,
  "U": "fly",
  "Shift F12": { "show": "hdr#1", "as": "scale", "channel": "G", "high": 4 },
  "Enter": { "step": "exposure", "by": -1 }
})",
           "keys.json", said);
  CHECK(said.text() == "");
  CHECK(keys.find('F', WithKey::nothing) == nullptr);
  CHECK(keys.find('U', WithKey::nothing)->help == "fly, with the mouse captured; again: back to turning");
  const auto help = keys.help();
  CHECK(std::ranges::count(help, std::pair<std::string, std::string>("Shift F12", "show hdr#1")) == 1);
  CHECK(help.back() == std::pair<std::string, std::string>("Enter", "step exposure"));
  keys.add(R"({
  "Shfit F12": "fly",
  "G": "flu",
  "H": { "do": "fly", "toggle": "bloom" },
  "U": { "show": "hdr", "as": "colour", "low": [1] },
  "L": { "toggle": "bloom", "speed": 2 },
  "J": {},
  "J": "fly",
  "PgDn": 7
})",
           "keys.json", said);
  std::string text;
  for (const text::Diagnostic& each : said.items())
    text += std::to_string(each.place.line) + ":" + std::to_string(each.place.column) + " " +
            text::nameOf(each.code) + "\n";
  CHECK(text ==
        "8:3 W006\n2:4 W011\n3:9 W011\n4:33 W014\n5:32 W011\n5:48 W003\n6:29 W004\n7:8 W005\n9:11 W003\n");
  CHECK(keys.find('U', WithKey::nothing)->name == "fly");
  CHECK(keys.find('L', WithKey::nothing)->name == "wireframe");
}

TEST_CASE(
    "time: the wall's, none while nothing is drawn, fixed steps while "
    "recording") {
  FrameClock clock;
  CHECK(clock.tick(100).time == 0);
  CHECK(clock.tick(100.5).time == doctest::Approx(0.5));
  clock.skip(200);
  CHECK(clock.tick(200.25).time == doctest::Approx(0.75));
  CHECK(clock.tick(150).delta == 0);  // a wall clock that goes backwards
  clock.worked();
  CHECK(clock.tick(160).delta == FrameClock::kWorkStep);  // what only the frame before had to do
  CHECK(clock.tick(160.5).delta == doctest::Approx(0.5));
  clock.worked();
  CHECK(clock.tick(160.51).delta == doctest::Approx(0.01));
  clock.fix(60);
  for (int frame = 1; frame <= 120; ++frame) {
    const FrameClock::Tick tick = clock.tick(1000.0 * frame);
    CHECK(tick.delta == 1 / 60.0);
    CHECK(tick.time == doctest::Approx(1.31 + frame / 60.0));
  }
  clock.fix(0);
  CHECK(clock.tick(120000.5).delta == doctest::Approx(0.5));
}

TEST_CASE("a recording from the start has the times of weft render, to the bit") {
  FrameClock clock;
  clock.fix(24);
  for (std::uint32_t frame = 0; frame < 1000; ++frame) {
    const FrameClock::Tick tick = clock.tick(frame * 0.731);
    CHECK(tick.time == frame / 24.0);
    CHECK(tick.delta == 1.0 / 24.0);
  }
}

TEST_CASE("rest is several equal looks in a row, and ends with a disturbance") {
  PictureRest rest;
  CHECK(rest.wantsLook(0));
  double now = 0;
  const auto look = [&](std::uint64_t hash) { rest.look(now += PictureRest::kBetweenLooks, hash); };
  look(1);
  CHECK_FALSE(rest.wantsLook(now));
  CHECK(rest.wantsLook(now + PictureRest::kBetweenLooks));
  for (int i = 0; i < 3; ++i) look(1);
  CHECK_FALSE(rest.resting());
  look(2);
  for (int i = 0; i < PictureRest::kLooks - 1; ++i) {
    CHECK_FALSE(rest.resting());
    look(2);
  }
  CHECK(rest.resting());
  CHECK_FALSE(rest.wantsLook(now + 100));
  rest.disturb();
  CHECK_FALSE(rest.resting());
  CHECK(rest.wantsLook(now));
}

}  // namespace
TEST_CASE(
    "the log shows errors first, the newest on top, and forgets what was "
    "dismissed until it is said again") {
  using app::ui::Log;
  const auto said = [](text::Severity severity, const char* message) {
    text::Diagnostic diagnostic;
    diagnostic.severity = severity;
    diagnostic.message = message;
    return diagnostic;
  };
  const auto textOf = [](const Log& log, bool all) {
    std::string text;
    for (const text::Diagnostic* each : log.shown(all)) text += each->message + ' ';
    return text;
  };
  using enum text::Severity;
  Log log;
  log.set(Log::kEnvironment, {said(warning, "hot")});
  text::Diagnostics past;
  past.add(said(error, "full"));
  log.addPast(past);
  log.set(Log::kFiles, {said(warning, "odd"), said(error, "broken")});
  CHECK(textOf(log, true) == "broken full odd hot ");
  CHECK(textOf(log, false) == "broken odd ");
  log.set(Log::kChange, {said(error, "refused")});
  CHECK(textOf(log, true) == "refused broken full odd hot ");
  log.dismiss();
  CHECK(textOf(log, true).empty());
  log.addPast(past);  // once is enough
  CHECK(textOf(log, true).empty());
  log.set(Log::kFiles, {said(error, "broken")});
  CHECK(textOf(log, true) == "broken ");
}

TEST_CASE("a box of the passes turns off what F8 can write, and turns it on again") {
  graph::FlatGraph flat;
  const auto add = [&](const char* name, const char* file, std::uint32_t line) {
    graph::PassSpec& spec = flat.specs.emplace_back();
    spec.name = spec.declared = name;
    spec.place = {file, line, 5};
  };
  add("lit.sky", "lit.json", 3);
  add("lit.balls", "lit.json", 9);
  add("fade.old.balls", "lit.json", 9);
  add("fade.balls", "fade.json", 9);
  add("one.lit.down", "lit.json", 12);
  add("two.lit.down", "lit.json", 12);
  CHECK(ui::switchNameOf(flat, 0) == "lit.sky");
  CHECK(ui::switchNameOf(flat, 1) == "balls");
  CHECK(ui::switchNameOf(flat, 2) == "balls");
  CHECK(ui::switchNameOf(flat, 3) == "fade.balls");
  CHECK(ui::switchNameOf(flat, 5) == "lit.down");

  graph::Settings settings;
  settings.disables = {{"sky"}, {"balls", graph::Origin::panel}, {"fade"}};
  const auto by = [&](const char* name) { return ui::disabledBy({.name = name}, settings); };
  CHECK(by("lit.sky") == "sky");
  CHECK(by("fade.old.balls") == "balls");
  CHECK(by("fade.old.stars") == "fade");
  CHECK(by("lit.stars").empty());
}

TEST_CASE("time that is held stands still but for steps, and can begin anew") {
  FrameClock clock;
  clock.tick(10);
  CHECK(clock.tick(11).time == doctest::Approx(1));
  clock.pause(true);
  CHECK(clock.tick(12).delta == 0);
  clock.step();
  CHECK(clock.tick(13).time == doctest::Approx(1 + FrameClock::kHeldStep));
  CHECK(clock.tick(14).delta == 0);
  clock.begin();
  CHECK(clock.tick(15).time == 0);
  clock.pause(false);
  CHECK(clock.tick(15.5).time == doctest::Approx(0.5));
}

}  // namespace weft::app
