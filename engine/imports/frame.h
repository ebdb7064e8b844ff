// What a provider makes its textures, buffers and views from: the inputs of one frame, and what providers of one device
// share. A bundle of references, made anew for each call.
#pragma once

#include <glad/gl.h>

#include <cstdint>

namespace weft::imports {

class CameraViews;
class Files;
class SceneTables;
class World;
struct FrameInput;

struct BufferRef {
  GLuint id = 0;
  std::uint64_t bytes = 0;
};

struct Frame {
  const World& world;
  const FrameInput& input;
  std::uint64_t number = 0;  // of the frames of this device; not input.frame, which may stand still or jump
  Files& files;
  SceneTables& tables;  // rows of the draw lists
  CameraViews& camera;  // the scene's camera as it is
  std::uint64_t& generations;

  // A generation that nothing on this device has had.
  std::uint64_t newGeneration() const { return ++generations; }
};

}  // namespace weft::imports
