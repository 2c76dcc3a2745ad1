#include "scenes/obj_model.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <filesystem>
#include <map>
#include <sstream>

#include "base/error.h"
#include "base/file.h"
#include "base/portable_math.h"
#include "scenes/material_image.h"

namespace twinshade {
namespace {

namespace fs = std::filesystem;

std::string one_line(std::string text) {
  text = text.substr(0, text.find('\n'));
  return text.empty() ? "unknown reason" : text;
}

// A texture's path beside the model; MTL files from Windows write backslashes.
std::string texture_path(const std::string& model, std::string name) {
  for (char& c : name)
    if (c == '\\') c = '/';
  return (fs::path(model).parent_path() / name).string();
}

class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path) {}

  Model read() {
    model_.files.push_back(path_);
    check_material_libraries(read_file(path_));
    Assimp::Importer importer;
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    const aiScene* scene = importer.ReadFile(path_, aiProcess_Triangulate | aiProcess_SortByPType);
    if (!scene || !scene->mRootNode)
      throw UserError(path_ + ": cannot be read: " + one_line(importer.GetErrorString()));
    model_.cos_crease = portable::cos(portable::kPi / 4);
    for (unsigned i = 0; i < scene->mNumMaterials; ++i) read_material(*scene->mMaterials[i]);
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) read_mesh(*scene->mMeshes[i]);
    return std::move(model_);
  }

 private:
  // assimp leaves out a library that is not there without a word.
  void check_material_libraries(const std::string& content) {
    std::istringstream lines(content);
    for (std::string line; std::getline(lines, line);) {
      if (line.compare(0, 7, "mtllib ") != 0) continue;
      std::string name = line.substr(7);
      while (!name.empty() && (name.back() == '\r' || name.back() == ' ')) name.pop_back();
      std::error_code code;
      model_.files.push_back(texture_path(path_, name));
      if (!fs::exists(model_.files.back(), code))
        model_.notes.push_back("material library " + name + " is missing: its materials are plain");
    }
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
      material.albedo_image = use_image(file.C_Str(), false);
      // Many exporters write a black Kd beside an image.
      if (material.albedo == glm::vec3(0)) material.albedo = glm::vec3(1);
    }
    if (from.GetTexture(aiTextureType_NORMALS, 0, &file) == AI_SUCCESS ||
        from.GetTexture(aiTextureType_HEIGHT, 0, &file) == AI_SUCCESS)
      material.normal_image = use_image(file.C_Str(), true);
    model_.materials.push_back(material);
  }

  // -1: a height field where a normal map is wanted.
  int use_image(const std::string& name, bool is_normal) {
    const std::string path = texture_path(path_, name);
    const auto key = std::make_pair(path, is_normal);
    if (const auto known = images_.find(key); known != images_.end()) return known->second;
    model_.files.push_back(path);
    const DecodedImage decoded = decode_image_file(path);
    if (is_normal && !looks_like_normal_map(decoded)) {
      model_.notes.push_back("bump map " + name + " is a height field, not a normal map: ignored");
      return images_[key] = -1;
    }
    model_.images.push_back(is_normal ? normal_image(decoded, 1) : albedo_image(decoded, path));
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
  std::map<std::pair<std::string, bool>, int> images_;
};

}  // namespace

Model read_obj_model(const std::string& path) { return Reader(path).read(); }

}  // namespace twinshade
