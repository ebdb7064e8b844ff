#include "app/view/camera_rig.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace weft::app {
namespace {

using Mode = CameraRig::Mode;

scene::CameraPose start() {
  return {.position = {3, 2, 10}, .target = {1, 0.5, -2}, .fovDegrees = 50, .nearPlane = 0.05};
}

// Where the hand has been at a time: a mouse in pixels, and keys that change at times every frame rate here
// has.
CameraInput handBetween(double from, double to) {
  const auto mouse = [](double t) {
    return glm::dvec2(220 * std::sin(2.1 * t) + 40 * t, 90 * std::cos(1.7 * t));
  };
  const auto wheel = [](double t) { return 3 * std::sin(1.3 * t); };
  CameraInput input;
  input.turn = mouse(to) - mouse(from);
  input.pan = glm::dvec2(input.turn.y, input.turn.x) * 0.5;
  input.wheel = wheel(to) - wheel(from);
  const double t = (from + to) / 2;
  const int second = static_cast<int>(t);
  if (t < 8) input.move = {second % 3 - 1, second % 2, second % 4 == 3 ? -1 : 1};
  input.fast = second % 5 == 4;
  return input;
}

// Ten seconds of poses, one each sixth of a second, with frames that end where `nextFrame(t, sixth)` says.
std::vector<scene::CameraPose> walk(Mode mode, const std::function<double(double, double)>& nextFrame) {
  CameraRig rig(start());
  rig.setMode(mode);
  rig.headBob = true;
  std::vector<scene::CameraPose> poses;
  double now = 0;
  for (int sixth = 1; sixth <= 60; ++sixth) {
    for (const double end = sixth / 6.0; now < end;) {
      const double next = std::min(nextFrame(now, end), end);
      const double to = end - next < 1e-9 ? end : next;
      rig.advance(to - now, handBetween(now, to));
      now = to;
    }
    poses.push_back(rig.pose());
  }
  return poses;
}

std::function<double(double, double)> at(double rate) {
  return [rate](double t, double) { return (std::floor(t * rate + 1e-6) + 1) / rate; };
}

void checkSame(const std::vector<scene::CameraPose>& a, const std::vector<scene::CameraPose>& b,
               double tolerance) {
  REQUIRE(a.size() == b.size());
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    worst =
        std::max({worst, glm::length(a[i].position - b[i].position), glm::length(a[i].target - b[i].target)});
  CHECK(worst < tolerance);
  CHECK(glm::length(a.front().position - a.back().position) > 1);  // it went somewhere
}

}  // namespace

// The tolerance is what reading a curved mouse path at 30 frames a second loses, at a distance of about 12:
// the chord of an arc, a'' h^2 / 8 = 970 px/s^2 / 900 s^2 / 8 = 0.13 px = 0.0007 rad, times 12; flying adds
// up the angle's error times the speed of up to 20.
TEST_CASE("the same hand takes the camera the same way at every frame rate") {
  for (const Mode mode : {Mode::orbit, Mode::fly}) {
    CAPTURE(static_cast<int>(mode));
    const auto sixty = walk(mode, at(60));
    const double tolerance = mode == Mode::orbit ? 0.02 : 0.05;
    checkSame(sixty, walk(mode, at(30)), tolerance);
    checkSame(sixty, walk(mode, at(144)), tolerance);
    checkSame(sixty, walk(mode, at(1000)), tolerance);
    for (const unsigned seed : {1u, 2u, 3u}) {
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> length(0.0005, 0.05);
      checkSame(sixty, walk(mode, [&](double t, double) { return t + length(random); }), tolerance);
    }
  }
}

TEST_CASE("keys alone give the same path to rounding") {
  const auto fly = [](double rate) {
    CameraRig rig(start());
    rig.setMode(Mode::fly);
    CameraInput input;
    input.move = {0.5, 0, 1};
    for (int i = 0; i < static_cast<int>(rate) * 3; ++i) rig.advance(1 / rate, input);
    return rig.pose().position;
  };
  CHECK(glm::length(fly(60) - fly(30)) < 1e-9);
  CHECK(glm::length(fly(60) - fly(144)) < 1e-9);
  CHECK(glm::length(fly(60) - fly(600)) < 1e-9);
}

TEST_CASE("flying accelerates, coasts and comes to rest; at rest nothing drifts") {
  CameraRig rig(start());
  rig.setMode(Mode::fly);
  CameraInput forward;
  forward.move = {0, 0, 1};
  rig.advance(0.1, forward);
  const glm::dvec3 a = rig.pose().position;
  CHECK(glm::length(a - start().position) < rig.speed() * 0.1 * 0.5);  // slower at first
  rig.advance(0.3, forward);
  CHECK(rig.moving());
  const glm::dvec3 b = rig.pose().position;
  for (int i = 0; i < 200; ++i) rig.advance(1.0 / 60, {});
  const scene::CameraPose rest = rig.pose();
  CHECK(glm::length(rest.position - b) > 0.05 * rig.speed());
  CHECK_FALSE(rig.moving());
  for (int i = 0; i < 100000; ++i) rig.advance(1.0 / 144, {});
  CHECK(rig.pose() == rest);
}

TEST_CASE("head-bob moves the view and not the way") {
  const auto fly = [](bool bob) {
    CameraRig rig(start());
    rig.setMode(Mode::fly);
    rig.headBob = bob;
    CameraInput forward;
    forward.move = {0, 0, 1};
    double highest = 0;
    for (int i = 0; i < 120; ++i) {
      rig.advance(1.0 / 60, forward);
      const scene::CameraPose pose = rig.pose();
      const glm::dvec3 ahead = glm::normalize(pose.target - pose.position),
                       from = pose.position - start().position;
      highest = std::max(highest, glm::length(from - ahead * glm::dot(from, ahead)));
    }
    for (int i = 0; i < 300; ++i) rig.advance(1.0 / 60, {});
    return std::pair(rig.pose(), highest);
  };
  const auto [with, bobbed] = fly(true);
  const auto [without, straight] = fly(false);
  CHECK(straight < 1e-9);
  CHECK(bobbed > 0.02);
  CHECK(bobbed < 0.5);
  CHECK(glm::length(with.position - without.position) < 1e-9);
}

TEST_CASE("no length of a frame and no input makes a pose that is not finite; a huge frame is cut short") {
  for (const Mode mode : {Mode::scene, Mode::orbit, Mode::fly}) {
    CameraRig rig(start());
    rig.setMode(mode);
    rig.headBob = true;
    for (const double seconds : {0.0, 1e-300, 1e9, -1.0, 1.0 / 60})
      for (const double wild : {0.0, 1.0, -1e5, 1e5}) {
        CameraInput input;
        input.turn = input.pan = {wild, -wild};
        input.wheel = wild;
        input.move = {wild, wild, wild};
        rig.advance(seconds, input);
        const scene::CameraPose pose = rig.pose();
        for (int axis = 0; axis < 3; ++axis) REQUIRE(std::isfinite(pose.position[axis]));
        for (int axis = 0; axis < 3; ++axis) REQUIRE(std::isfinite(pose.target[axis]));
        REQUIRE(glm::length(pose.position - pose.target) > 0);
      }
  }
  CameraRig rig(start());
  rig.setMode(Mode::fly);
  CameraInput forward;
  forward.move = {0, 0, 1};
  rig.advance(1e9, forward);
  CHECK(glm::length(rig.pose().position - start().position) <= rig.speed() * CameraRig::kLongestFrame);
}

TEST_CASE("an orbit stays above the ground, whatever the hand does; below it or in flight there is none") {
  std::mt19937 random(7);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (const double fps : {3.0, 60.0}) {
    CameraRig rig(start());
    rig.ground = 0.25;
    double least = 1e9;
    for (int frame = 0; frame < 3000; ++frame) {
      CameraInput input;
      input.turn = {between(-30, 30), between(-60, 40)};
      if (frame % 7 == 0) input.wheel = between(-4, 4);
      if (frame % 5 == 0) input.pan = {between(-20, 20), between(-3, 3)};
      rig.advance(1 / fps, input);
      least = std::min(least, rig.pose().position.y);
    }
    CHECK(least >= 0.25);
    CHECK(least < 0.25 + 3 * start().nearPlane);  // it came as far down as it may
  }
  // Flying while looking down leaves a pivot below the ground.
  scene::CameraPose down = start();
  down.target = {3, -2.5, 5};
  CameraRig digger(down), slider(down);
  digger.ground = slider.ground = 0;
  for (int frame = 0; frame < 300; ++frame) {
    digger.advance(0.02, {.wheel = 0.5});
    slider.advance(0.02, {.pan = {0, -4}});
    CHECK(digger.pose().position.y >= 0);
    CHECK(slider.pose().position.y <= 2);
  }
  CHECK(digger.pose().position.y < 3 * down.nearPlane);
  CHECK(glm::length(glm::normalize(digger.pose().target - digger.pose().position) -
                    glm::normalize(down.target - down.position)) < 1e-3);  // it looks where it did
  CHECK(slider.pose().position.y == doctest::Approx(2 * down.nearPlane));
  for (int frame = 0; frame < 300; ++frame) digger.advance(0.02, {.wheel = -0.5});
  CHECK(digger.pose().position.y > 20);
  scene::CameraPose low{.position = {0, 0.01, 0.3}, .target = {0, 0, 0}, .nearPlane = 0.1};
  CameraRig ant(low);
  ant.ground = 0;
  ant.advance(0.02, {.turn = {5, 0}});
  CHECK(ant.pose().position.y == doctest::Approx(0.01));
  scene::CameraPose below = start();
  below.position.y = -1;
  CameraRig mole(below), worm(below), bird(start());
  mole.ground = worm.ground = bird.ground = 0;
  bird.setMode(Mode::fly);
  for (int frame = 0; frame < 100; ++frame) {
    mole.advance(0.01, {.turn = {0, -10}});
    worm.advance(0.01, {.pan = {0, -10}});
    bird.advance(0.05, {.move = {0, -1, 0}});
  }
  CHECK(mole.pose().position.y < -5);
  CHECK(worm.pose().target.y < -1);
  CHECK(bird.pose().position.y < 0);
}

TEST_CASE("the mouse of a frame that took no time, or too much, is not lost") {
  const auto turned = [](double seconds) {
    CameraRig rig(start());
    CameraInput input;
    input.turn = {100, 0};
    rig.advance(seconds, input);
    for (int i = 0; i < 120; ++i) rig.advance(1.0 / 60, {});
    return rig.pose().position;
  };
  CHECK(glm::length(turned(1.0 / 60) - start().position) > 1);
  CHECK(glm::length(turned(0) - turned(1.0 / 60)) < 1e-6);
  CHECK(glm::length(turned(1000) - turned(1.0 / 60)) < 1e-6);
}

TEST_CASE("changing the way to move keeps the pose, bit for bit before anything moves") {
  CameraRig rig(start());
  for (const Mode mode : {Mode::fly, Mode::orbit, Mode::fly, Mode::scene}) {
    rig.setMode(mode);
    rig.advance(1.0 / 60, {});
    CHECK(rig.pose() == start());
  }
  for (const Mode mode : {Mode::orbit, Mode::fly, Mode::orbit}) {
    for (int i = 0; i < 60; ++i) rig.advance(1.0 / 60, handBetween(i / 60.0, (i + 1) / 60.0));
    const scene::CameraPose before = rig.pose();
    rig.setMode(mode);
    CHECK(glm::length(rig.pose().position - before.position) < 1e-9);
    CHECK(glm::length(rig.pose().target - before.target) < 1e-9);
  }
}

TEST_CASE("a jump is a cut and follows to the letter, straight down too") {
  CameraRig rig(start());
  const std::uint64_t cuts = rig.cuts();
  for (const glm::dvec3 from : {glm::dvec3(0, 20, 0), glm::dvec3(0, -20, 0), glm::dvec3(-20, 0, 0)}) {
    const scene::CameraPose pose{.position = from, .target = {0, 0, 0}};
    rig.jumpTo(pose);
    CHECK(rig.pose() == pose);
    CHECK(rig.mode() == Mode::scene);
    CameraInput wheel;  // leaves the angles alone
    wheel.wheel = 1;
    rig.advance(1.0 / 60, wheel);
    for (int i = 0; i < 120; ++i) rig.advance(1.0 / 60, {});
    CHECK(glm::length(glm::normalize(rig.pose().position) - glm::normalize(from)) < 1e-6);
    CHECK(glm::length(rig.pose().position) == doctest::Approx(18));
  }
  CHECK(rig.cuts() == cuts + 3);
}

TEST_CASE("following a camera of the scene is no cut; the first touch takes the camera over") {
  CameraRig rig(start());
  const std::uint64_t cuts = rig.cuts();
  scene::CameraPose pose = start();
  pose.position.x += 1;
  rig.follow(pose);
  CHECK(rig.pose() == pose);
  CHECK(rig.cuts() == cuts);
  CameraInput input;
  input.move = {0, 0, 1};
  rig.advance(1.0 / 60, input);
  CHECK(rig.mode() == Mode::scene);  // keys fly, and do nothing else
  input.turn = {1, 0};
  rig.advance(1.0 / 60, input);
  CHECK(rig.mode() == Mode::orbit);
}

}  // namespace weft::app
