#include "scenes/obj_model.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <exception>
#include <filesystem>
#include <map>
#include <new>
#include <set>
#include <sstream>
#include <string_view>

#include "base/error.h"
#include "base/file.h"
#include "base/portable_math.h"
#include "scenes/material_image.h"
#include "scenes/mtl_lines.h"
#include "scenes/obj_indices.h"
#include "scenes/obj_lines.h"
#include "scenes/read_for_model.h"

namespace twinshade {
namespace {

namespace fs = std::filesystem;

std::string first_line(std::string text) {
  text = text.substr(0, text.find('\n'));
  return text.empty() ? "unknown reason" : text;
}

// A texture's path beside the model; MTL files from Windows write backslashes.
std::string texture_path(const std::string& model, std::string name) {
  for (char& c : name)
    if (c == '\\') c = '/';
  return (fs::path(model).parent_path() / name).string();
}

// assimp takes a byte order mark for a part of the first line, and leaves that out.
std::string without_byte_order_mark(std::string text) {
  if (text.compare(0, 3, "\xef\xbb\xbf") == 0) text.erase(0, 3);
  return text;
}

std::string trimmed(const std::string& text) {
  const char* const blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

// "red" of "usemtl red"; empty where the statement has another keyword.
std::string name_behind(std::string_view keyword, std::string_view statement) {
  const bool has = statement.starts_with(keyword) && statement.size() > keyword.size() &&
                   (statement[keyword.size()] == ' ' || statement[keyword.size()] == '\t');
  return has ? trimmed(std::string(statement.substr(keyword.size()))) : "";
}

std::string library_name(std::size_t index) { return "library_" + std::to_string(index); }

// What assimp sees: the model's text, and its material libraries as library_name calls them.
class Files : public Assimp::DefaultIOSystem {
 public:
  Files(std::string path, std::string text, std::vector<std::string> libraries)
      : path_(std::move(path)), text_(std::move(text)), libraries_(std::move(libraries)) {}

  Assimp::IOStream* Open(const char* file, const char*) override {
    if (file == path_) return stream(text_);
    for (std::size_t i = 0; i < libraries_.size(); ++i)
      if (fs::path(file).filename() == library_name(i)) return stream(libraries_[i]);
    return nullptr;
  }

 private:
  static Assimp::IOStream* stream(const std::string& text) {
    auto* bytes = new std::uint8_t[text.size()];
    std::copy(text.begin(), text.end(), bytes);
    return new Assimp::MemoryIOStream(bytes, text.size(), true);
  }

  std::string path_, text_;
  std::vector<std::string> libraries_;  // their texts
};

// Lines of old Macintoshes end in carriage returns alone.
std::string with_line_feeds(std::string text) {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n')) text[i] = '\n';
  return text;
}

// assimp keeps what it meets to itself; how lack of memory is told is the caller's.
void rethrow_lack_of_memory(const std::exception_ptr& exception) {
  try {
    std::rethrow_exception(exception);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (...) {
  }
}

class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path) {}

  Model read() {
    model_.files.push_back(path_);
    std::string text = with_libraries(with_line_feeds(without_byte_order_mark(read_file(path_))));
    Assimp::Importer importer;
    importer.SetIOHandler(new Files(path_, std::move(text), libraries_));  // which it deletes
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    const aiScene* scene = importer.ReadFile(path_, aiProcess_Triangulate | aiProcess_SortByPType);
    if (!scene || !scene->mRootNode) {
      if (importer.GetException()) rethrow_lack_of_memory(importer.GetException());
      throw UserError(path_ + ": cannot be read: " + first_line(importer.GetErrorString()));
    }
    model_.cos_crease = portable::cos(portable::kPi / 4);
    for (unsigned i = 0; i < scene->mNumMaterials; ++i) read_material(*scene->mMaterials[i]);
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) read_mesh(*scene->mMeshes[i]);
    return std::move(model_);
  }

 private:
  // The model's text with a line for each material library that is there: assimp takes all names of a line for one,
  // and puts another file in the place of one that is missing.
  std::string with_libraries(const std::string& content) {
    constexpr std::string_view kLibrary = "mtllib";
    std::string text;
    text.reserve(content.size());
    ObjIndices indices;
    std::set<std::string> undrawn;
    for (ObjLines lines(content); lines.next(); text += '\n') {
      const std::string_view line = lines.statement();
      const std::string_view rest = line.substr(std::min(kLibrary.size(), line.size()));
      if (!line.starts_with(kLibrary) || (!rest.empty() && rest.find_first_of(" \t") != 0)) {
        indices.read(line, path_, lines.number());
        if (const std::string name = name_behind("usemtl", line); !name.empty()) used_.emplace(name, lines.number());
        add_statement(text, line, path_, lines.number());
        if (std::string what = undrawn_statement(line); !what.empty()) undrawn.insert(std::move(what));
        continue;
      }
      for (const std::string& name : library_names(trimmed(std::string(rest.substr(0, rest.find(" #")))))) {
        const std::string file = texture_path(path_, name);
        model_.files.push_back(file);
        std::error_code code;
        if (!fs::exists(file, code) || fs::is_directory(file, code)) {
          library_missing_ = true;
          model_.notes.push_back("material library " + name +
                                 (fs::exists(file, code) ? " is a folder" : " is missing") +
                                 ": its materials are plain");
          continue;
        }
        text += "mtllib " + library_name(libraries_.size()) + "\n";
        std::set<std::string> notes;
        libraries_.push_back(plain_materials(with_line_feeds(without_byte_order_mark(read_file(file))), file, notes));
        for (ObjLines in(libraries_.back()); in.next();) made_.insert(name_behind("newmtl", in.statement()));
        for (const std::string& note : notes) model_.notes.push_back("material library " + name + ": " + note);
      }
    }
    indices.check(path_);
    model_.notes.insert(model_.notes.end(), undrawn.begin(), undrawn.end());
    if (!library_missing_) note_unknown_materials();  // else that has been said
    return text;
  }

  void note_unknown_materials() {
    constexpr std::size_t kMost = 8;
    std::string names;
    std::size_t unknown = 0, first = 0;
    for (const auto& [name, line] : used_) {
      if (made_.count(name)) continue;
      if (unknown++ < kMost) names += (names.empty() ? "" : ", ") + name;
      first = first ? std::min(first, line) : line;
    }
    if (unknown > kMost) names += " and " + std::to_string(unknown - kMost) + " more";
    if (unknown > 0)
      model_.notes.push_back("line " + std::to_string(first) + ": usemtl names what no material library has, " + names +
                             ": plain");
  }

  // Names may have blanks in them: a file of the whole name is the one that is meant.
  std::vector<std::string> library_names(const std::string& all) const {
    std::error_code code;
    if (!all.empty() && fs::exists(texture_path(path_, all), code)) return {all};
    std::istringstream words(all);
    std::vector<std::string> names;
    for (std::string name; words >> name;) names.push_back(name);
    return names;
  }

  void read_material(const aiMaterial& from) {
    Material material;
    aiString name;
    if (from.Get(AI_MATKEY_NAME, name) == AI_SUCCESS) material.name = name.C_Str();
    aiColor3D colour(0.8f, 0.8f, 0.8f);
    from.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
    material.albedo = {colour.r, colour.g, colour.b};
    aiString file;
    if (from.GetTexture(aiTextureType_DIFFUSE, 0, &file) == AI_SUCCESS) {
      material.albedo_image = use_image(file.C_Str(), Use::colours);
      // Many exporters write a black Kd beside an image.
      if (material.albedo == glm::vec3(0)) material.albedo = glm::vec3(1);
    }
    if (from.GetTexture(aiTextureType_NORMALS, 0, &file) == AI_SUCCESS)
      material.normal_image = use_image(file.C_Str(), Use::normals);
    else if (from.GetTexture(aiTextureType_HEIGHT, 0, &file) == AI_SUCCESS)
      material.normal_image = use_image(file.C_Str(), Use::bumps);
    model_.materials.push_back(material);
  }

  // bumps: a normal map by its looks, or a height field. normals: the file says so (`norm`).
  enum class Use { colours, normals, bumps };

  // -1: a height field where a normal map is wanted.
  int use_image(const std::string& name, Use use) {
    const std::string path = texture_path(path_, name);
    const auto key = std::make_pair(path, use);
    if (const auto known = images_.find(key); known != images_.end()) return known->second;
    model_.files.push_back(path);
    const DecodedImage decoded = read_for_model(path_, [&] { return decode_image_file(path); });
    if (!decoded.note.empty()) model_.notes.push_back(name + ": " + decoded.note);
    if (use == Use::bumps && !looks_like_normal_map(decoded)) {
      model_.notes.push_back("bump map " + name + " is a height field, not a normal map: ignored");
      return images_[key] = -1;
    }
    model_.images.push_back(read_for_model(
        path_, [&] { return use == Use::colours ? albedo_image(decoded, path) : normal_image(decoded, 1); }));
    return images_[key] = int(model_.images.size()) - 1;
  }

  void read_mesh(const aiMesh& mesh) {
    ModelPart part;
    part.name = std::string("mesh '") + mesh.mName.C_Str() + "'";
    part.material = int(mesh.mMaterialIndex);
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      part.positions.emplace_back(mesh.mVertices[i].x, mesh.mVertices[i].y, mesh.mVertices[i].z);
      if (mesh.HasNormals()) part.normals.emplace_back(mesh.mNormals[i].x, mesh.mNormals[i].y, mesh.mNormals[i].z);
      if (mesh.HasTextureCoords(0)) part.uvs.emplace_back(mesh.mTextureCoords[0][i].x, mesh.mTextureCoords[0][i].y);
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f)
      if (mesh.mFaces[f].mNumIndices == 3)
        for (unsigned k = 0; k < 3; ++k) {
          const unsigned index = mesh.mFaces[f].mIndices[k];
          if (index >= mesh.mNumVertices)
            throw UserError(path_ + ": damaged: " + part.name + " has a vertex index out of range");
          part.indices.push_back(index);
        }
    if (!part.indices.empty()) model_.parts.push_back(std::move(part));
  }

  std::string path_;
  Model model_;
  std::vector<std::string> libraries_;       // texts of those that are there, in the model's order
  std::map<std::string, std::size_t> used_;  // materials by name, with the first line of each
  bool library_missing_ = false;
  std::set<std::string> made_;  // by the libraries
  std::map<std::pair<std::string, Use>, int> images_;
};

}  // namespace

Model read_obj_model(const std::string& path) { return Reader(path).read(); }

}  // namespace twinshade
