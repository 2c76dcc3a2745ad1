// The search of `choose`: for each technique and place of its light the least that one must store for a frame within an
// error.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/candidate.h"
#include "app/frame_truth.h"
#include "lighting/stored_light.h"

namespace twinshade {

// A technique with its light stored in one way.
struct Choice : Candidate {
  CoefficientStorage place = CoefficientStorage::lightmap;
  std::uint32_t lightmap = 0;  // texels each way; 0: not from lightmaps
  glm::ivec3 volume{0};        // probes; 0: not from a volume
  int map_width = 0;           // of its tables' sphere map; 0: none
  TexelStorage storage = TexelStorage::float32;
  std::uint64_t bytes = 0;  // of all light that it reads

  std::string size() const;  // "256", "8x4x8"; "-" for vertices
};

struct SearchOptions {
  double max_error = 0;
  std::vector<TexelStorage> storages;  // the most precise first
};

struct SearchResult {
  std::vector<Choice> tried;
  // Of each technique, place and map the one within the error that has the fewest bytes, and its light.
  std::vector<Choice> best;
  std::vector<StoredLight> lights;
};

class ChoiceSearch {
 public:
  // shading: what wanted techniques were planned by, with their maps. All are kept by reference.
  ChoiceSearch(const LitScene& lit, const SubjectOptions& subject, const ShadingOptions& shading,
               const CommonOptions& common, const CpuOptions& cpu, const Truths& truths, const Output& output);

  // Lightmaps and volumes are halved while something is within the error, and tables likewise at each of their sizes,
  // in the most precise storage; then the others are tried of the fewest bytes. What is not within the error at two
  // sizes in a row, or at the first, is not looked at where it is smaller.
  SearchResult run(const std::vector<LitTechnique>& wanted, const SearchOptions& options);

 private:
  using Key = std::pair<std::string, std::string>;  // technique and map

  struct Best {
    Choice choice;
    StoredLight light;
  };

  void search_place(CoefficientStorage place, const std::vector<std::string>& techniques);
  // Those of `keys` that are within the error at this size, halved widths left out.
  std::set<Key> try_size(CoefficientStorage place, const SubjectOptions& at, const std::set<Key>& keys);
  std::set<Key> try_width(CoefficientStorage place, const SubjectOptions& at, const std::set<Key>& keys);
  void try_storages();
  bool measure(Choice& choice, const StoredLight& light);
  void keep(const Choice& choice, StoredLight light);

  const LitScene& lit_;
  const SubjectOptions& subject_;
  const ShadingOptions& shading_;
  const CommonOptions& common_;
  const Truths& truths_;
  const Output& output_;
  Machines machines_;
  RelitBundle bundle_;
  SearchOptions options_;
  SearchResult result_;
  std::vector<Best> best_;  // of the place that is searched
};

}  // namespace twinshade
