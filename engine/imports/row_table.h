// A table of rows on the device, in as many layouts as shaders ask for; each is filled when its generation is not the wanted one.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/diagnostic.h"
#include "engine/gl/objects/objects.h"
#include "engine/imports/frame.h"
#include "engine/imports/row_layout.h"

namespace weft::imports {

class RowTable {
 public:
  explicit RowTable(std::string label) : label_(std::move(label)) {}

  // `fill(layout, bytes)` writes all rows. Id 0 after an error.
  template <class Fill>
  BufferRef get(const RowLayout& layout, std::uint64_t generation, const Fill& fill,
                base::Diagnostics& diagnostics) {
    Copy& copy = copyOf(layout);
    if (copy.generation != generation) {
      fill(copy.layout, bytes_);
      if (!send(copy, diagnostics)) return {};
      copy.generation = generation;
    }
    return {copy.buffer.id(), copy.buffer.bytes()};
  }

 private:
  struct Copy {
    RowLayout layout;
    gl::Buffer buffer;
    std::uint64_t generation = 0;
  };
  Copy& copyOf(const RowLayout& layout);
  bool send(Copy& copy, base::Diagnostics& diagnostics);

  std::string label_;
  std::vector<std::unique_ptr<Copy>> copies_;
  std::vector<std::byte> bytes_;
};

}  // namespace weft::imports
