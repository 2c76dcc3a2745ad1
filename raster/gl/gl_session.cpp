#include "raster/gl/gl_session.h"

#include <algorithm>
#include <sstream>
#include <system_error>

#include "base/error.h"
#include "raster/gl/declaration.h"
#include "raster/gl/author_names.h"

namespace twinshade::gl {
namespace {

std::string names_of(const std::vector<Attribute>& attributes) {
  std::string names;
  for (const Attribute& attribute : attributes) names += (names.empty() ? "" : ", ") + attribute.name;
  return names.empty() ? "none" : names;
}

std::string leaf_type(Scalar scalar, std::uint32_t components) {
  const std::string prefix = scalar == Scalar::i32 ? "i" : scalar == Scalar::u32 ? "u" : "";
  if (components > 1) return prefix + "vec" + std::to_string(components);
  return scalar == Scalar::f32 ? "float" : prefix + (scalar == Scalar::u32 ? "int" : "nt");
}

// The first line of a driver's log that reports an error, with the author's file and line.
std::string first_error(const ShaderSource& source, const std::string& log) {
  std::istringstream lines(author_name(map_driver_log(source, log)));
  std::string first;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("error") != std::string::npos) return line;
    if (first.empty()) first = line;
  }
  return first;
}

bool about_generated_lines(const std::string& error) {
  return error.rfind(std::to_string(kGeneratedFile) + ":", 0) == 0;
}

}  // namespace

std::vector<Input> supplied_inputs(const std::vector<Attribute>& attributes, const ShaderSource& source,
                                   const std::vector<Input>& inputs) {
  std::vector<Input> supplied;
  for (const Input& input : inputs) {
    bool complete = true;
    for (const InputLeaf& leaf : leaves_of({input})) {
      const std::string name = author_name(leaf.name);
      const auto found =
          std::find_if(attributes.begin(), attributes.end(), [&](const Attribute& a) { return a.name == name; });
      const Attribute* attribute = found == attributes.end() ? nullptr : &*found;
      complete = complete && attribute != nullptr;
      if (!input.used) continue;
      const std::string what =
          position(source, input.where) + "input " + name + " (" + leaf_type(leaf.scalar, leaf.components) + ")";
      if (attribute == nullptr) throw UserError(what + " is not in the bundle, which has: " + names_of(attributes));
      if (attribute->scalar != leaf.scalar || attribute->components != leaf.components)
        throw UserError(what + " is " + leaf_type(attribute->scalar, attribute->components) + " in the bundle");
    }
    if (complete) supplied.push_back(input);
  }
  return supplied;
}

void put_uniforms(const Bundle& bundle, const ShaderSource& source, DrawRequest& request) {
  for (const std::string& name : initialized_uniforms(source)) {
    const auto given = [&](const Uniform& u) { return u.name.substr(0, u.name.find_first_of(".[")) == name; };
    if (std::none_of(bundle.uniforms.begin(), bundle.uniforms.end(), given)) request.initialized.push_back(name);
  }
  for (const Uniform& u : bundle.uniforms)
    request.uniforms.push_back({u.name, u.scalar, u.columns, u.rows, u.array_length, u.values});
}

DrawRequest request_for(const Bundle& bundle, const ShaderSource& source, const ShaderGenerator& generator,
                        double time_limit_seconds) {
  DrawRequest request;
  request.width = bundle.width, request.height = bundle.height;
  request.cull_back_faces = bundle.cull_back_faces;
  request.geometry = generator.geometry();
  request.leaves = generator.leaves();
  request.time_limit_seconds = time_limit_seconds;
  put_uniforms(bundle, source, request);
  return request;
}

DrawReply GlSession::exchange(const Bundle& bundle, const ShaderSource& source, DrawRequest& request,
                              std::size_t memory_size, const std::function<void()>& fill) {
  if (!worker_.running()) {  // a new one gets everything again
    image_.forget();
    shared_ = SharedMemory();
    worker_.start(request.time_limit_seconds);
    started_ = true;
  }
  std::vector<int> descriptors;
  try {
    request.new_image = image_.update(bundle);
    if (request.new_image) {
      request.image = image_.index();
      descriptors.push_back(image_.fd());
    }
    if (shared_.size() < memory_size) {
      shared_ = SharedMemory::create(memory_size);
      descriptors.push_back(shared_.fd());
    }
    fill();
  } catch (const std::system_error& error) {
    worker_.stop();
    throw BackendError(std::string(backend_name(backend_)) + ": " + error.what());
  }

  WireWriter writer;
  writer.put(request);
  DrawReply reply;
  const std::string answer = worker_.exchange(writer.take(), descriptors, request.time_limit_seconds);
  WireReader(answer).get(reply);
  if (reply.outcome != Outcome::ok) fail(source, reply);
  return reply;
}

void GlSession::fail(const ShaderSource& source, const DrawReply& reply) {
  const std::string name = backend_name(backend_), file = source.files.empty() ? source.name : source.files[0];
  if (reply.outcome == Outcome::user_error) throw UserError(file + ": " + reply.text);
  if (reply.outcome == Outcome::glsl_error) {
    const std::string error = first_error(source, reply.text);
    if (about_generated_lines(error)) throw BackendError(name + ": the driver rejects generated GLSL: " + error);
    // What an earlier version lacks, the translation takes from 450.
    const std::string remedy =
        !source.es && source.version < 450
            ? "; the CPU accepts it: GLSL " + std::to_string(source.version) + " may lack what #version 450 has"
            : std::string();
    throw UserError(error + " (" + name + remedy + ")");
  }
  worker_.stop();  // after a failed driver call nothing is known about its state
  throw BackendError(name + ": " + reply.text);
}

}  // namespace twinshade::gl
