// What the list of formats promises, held against the driver: its own answers (ARB_internalformat_query2), a framebuffer that is complete,
// what blending leaves in it, and GLSL that compiles with the qualifier.
#include <doctest/doctest.h>

#include <string>

#include "engine/graph/print/print.h"
#include "engine/runtime/storage/formats.h"
#include "tests/runtime/stage.h"

namespace storage_formats_test {

using namespace weft;
using namespace weft::runtime::test;

namespace {

bool driverSays(GLenum internal, GLenum question) {
  GLint answer = GL_NONE;
  glGetInternalformativ(GL_TEXTURE_2D, internal, question, 1, &answer);
  return answer == GL_FULL_SUPPORT;
}

bool isComplete(GLenum internal, GLenum attachment) {
  GLuint texture = 0, framebuffer = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &texture);
  glTextureStorage2D(texture, 1, internal, 4, 4);
  glCreateFramebuffers(1, &framebuffer);
  glNamedFramebufferTexture(framebuffer, attachment, texture, 0);
  const bool complete = glCheckNamedFramebufferStatus(framebuffer, GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  glDeleteFramebuffers(1, &framebuffer);
  glDeleteTextures(1, &texture);
  return complete;
}

// "", "u" or "i": what stands before vec4 and image2D.
std::string letterOf(graph::TexelKind kind) {
  return kind == graph::TexelKind::unsigned_integer ? "u"
         : kind == graph::TexelKind::signed_integer ? "i"
                                                    : "";
}

GLuint compiled(GLenum stage, const std::string& text) {
  const char* source = text.c_str();
  const GLuint shader = glCreateShader(stage);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  return shader;
}

bool compilesAsImage(const std::string& qualifier, graph::TexelKind kind) {
  const std::string letter = letterOf(kind);
  const GLuint shader =
      compiled(GL_COMPUTE_SHADER,
               "#version 450\nlayout(local_size_x = 1) in;\nlayout(" + qualifier + ") uniform writeonly " +
                   letter + "image2D a;\nvoid main() { imageStore(a, ivec2(0), " + letter + "vec4(1)); }\n");
  GLint good = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  glDeleteShader(shader);
  return good == GL_TRUE;
}

// Draws 1 over 0.25 (over 2 in whole numbers), times 0.5 and 1: red is then 0.75, or 1 where the format does not blend.
double redAfterBlending(GLenum internal, graph::TexelKind kind) {
  const std::string letter = letterOf(kind);
  const bool whole = !letter.empty();
  GLuint texture = 0, framebuffer = 0, vertices = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &texture);
  glTextureStorage2D(texture, 1, internal, 1, 1);
  glCreateFramebuffers(1, &framebuffer);
  glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, texture, 0);
  glCreateVertexArrays(1, &vertices);
  const float quarter[4] = {0.25f, 0.25f, 0.25f, 0.25f};
  const GLuint two[4] = {2, 2, 2, 2};
  whole ? glClearNamedFramebufferuiv(framebuffer, GL_COLOR, 0, two)
        : glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, quarter);
  const GLuint vertex = compiled(
      GL_VERTEX_SHADER,
      "#version 450\nvoid main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - "
      "1.0, 0.0, 1.0); }\n");
  const GLuint fragment =
      compiled(GL_FRAGMENT_SHADER,
               "#version 450\nout " + letter + "vec4 red;\nvoid main() { red = " + letter + "vec4(1); }\n");
  const GLuint program = glCreateProgram();
  for (const GLuint shader : {vertex, fragment}) {
    glAttachShader(program, shader);
    glDeleteShader(shader);
  }
  glLinkProgram(program);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, 1, 1);
  glBindVertexArray(vertices);
  glUseProgram(program);
  glEnable(GL_BLEND);
  glBlendColor(0.5f, 0.5f, 0.5f, 0.5f);
  glBlendFunc(GL_CONSTANT_COLOR, GL_ONE);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_BLEND);
  float red = -1;
  GLuint number = 0;
  whole ? glReadPixels(0, 0, 1, 1, GL_RED_INTEGER,
                       kind == graph::TexelKind::signed_integer ? GL_INT : GL_UNSIGNED_INT, &number)
        : glReadPixels(0, 0, 1, 1, GL_RED, GL_FLOAT, &red);
  glUseProgram(0);
  glBindVertexArray(0);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glDeleteProgram(program);
  glDeleteVertexArrays(1, &vertices);
  glDeleteFramebuffers(1, &framebuffer);
  glDeleteTextures(1, &texture);
  return whole ? static_cast<double>(number) : static_cast<double>(red);
}

}  // namespace

TEST_CASE("a format can what the list says that it can") {
  const CleanScope clean;
  for (const std::string& name : graph::formatNames()) {
    CAPTURE(name);
    const graph::Format format = *graph::findFormat(name);
    const graph::FormatInfo& info = graph::infoOf(format);
    const graph::FormatUses uses = graph::usesOf(format);
    const GLenum internal = runtime::glFormatOf(format);
    // Table 8.12 of the specification does not require these to be rendered to; this driver can, another need not.
    const bool notRequired = name.ends_with("_snorm") || name == "rgb9_e5";
    CHECK(uses.attachment != notRequired);
    if (uses.attachment) {
      CHECK(isComplete(internal, graph::hasStencil(format) ? GL_DEPTH_STENCIL_ATTACHMENT
                                 : graph::isDepth(format)  ? GL_DEPTH_ATTACHMENT
                                                           : GL_COLOR_ATTACHMENT0));
    }
    if (info.colorRenderable) {
      // 0.25 of an sRGB texture stays 0.25: conversion is off here, and rounds to a step of 255.
      CHECK(redAfterBlending(internal, info.kind) ==
            doctest::Approx(uses.blended ? 0.75 : 1.0).epsilon(0.01));
    } else {
      CHECK_FALSE(uses.blended);
    }
    CHECK(driverSays(internal, GL_FILTER) == uses.filtered);
    CHECK(driverSays(internal, GL_SHADER_IMAGE_STORE) == uses.image);
    CHECK(compilesAsImage(name, info.kind) == uses.image);
  }
}

}  // namespace storage_formats_test
