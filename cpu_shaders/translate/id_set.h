// A set of ids of which many, each little different from another, are kept at once: they share what they have in
// common. A binary trie over the bits of the ids, whose nodes never change (Okasaki, Gill, Fast mergeable integer maps,
// 1998): a change makes as many nodes as the ids have bits at most, and equal parts of two sets are not looked into.
#pragma once

#include <memory>
#include <utility>

#include "cpu_shaders/translate/spirv_module.h"

namespace twinshade::spirv {

class IdSet {
 public:
  bool count(Id id) const {
    const Node* n = root_.get();
    while (n != nullptr && n->branch != 0) n = n->below[(id & n->branch) != 0].get();
    return n != nullptr && n->id == id;
  }
  void insert(Id id) { root_ = unite(root_, std::make_shared<const Node>(Node{id, 0, {}})); }
  void insert(const IdSet& other) { root_ = unite(root_, other.root_); }
  void erase(Id id) { root_ = without(root_, id); }
  bool operator==(const IdSet& other) const { return equal(root_, other.root_); }

 private:
  struct Node;
  using Link = std::shared_ptr<const Node>;
  // A leaf, whose branch is 0, or all ids that agree with `id` in the bits above `branch`, and its own is 0 in `id`.
  struct Node {
    Id id, branch;
    Link below[2];  // with that bit 0 and 1
  };

  static bool covers(const Node& n, Id id) { return ((n.id ^ id) & ~(2 * n.branch - 1)) == 0; }

  static Link join(const Link& a, const Link& b) {
    Id branch = a->id ^ b->id;
    while ((branch & (branch - 1)) != 0) branch &= branch - 1;  // the highest bit in which they differ
    const bool swapped = (a->id & branch) != 0;
    return std::make_shared<const Node>(Node{a->id & ~(2 * branch - 1), branch, {swapped ? b : a, swapped ? a : b}});
  }

  static Link unite(const Link& a, const Link& b) {
    if (a == b || b == nullptr) return a;
    if (a == nullptr) return b;
    if (a->branch < b->branch) return unite(b, a);
    if (a->branch == 0) return a->id == b->id ? a : join(a, b);
    if (!covers(*a, b->id)) return join(a, b);
    Link below[2] = {a->below[0], a->below[1]};
    if (a->branch == b->branch) {
      for (int side : {0, 1}) below[side] = unite(below[side], b->below[side]);
      if (below[0] == b->below[0] && below[1] == b->below[1]) return b;
    } else {
      Link& side = below[(b->id & a->branch) != 0];
      side = unite(side, b);
    }
    if (below[0] == a->below[0] && below[1] == a->below[1]) return a;
    return std::make_shared<const Node>(Node{a->id, a->branch, {below[0], below[1]}});
  }

  static Link without(const Link& a, Id id) {
    if (a == nullptr || a->branch == 0) return a == nullptr || a->id == id ? nullptr : a;
    if (!covers(*a, id)) return a;
    const int side = (id & a->branch) != 0;
    const Link rest = without(a->below[side], id);
    if (rest == a->below[side]) return a;
    if (rest == nullptr) return a->below[1 - side];
    return std::make_shared<const Node>(
        Node{a->id, a->branch, {side == 0 ? rest : a->below[0], side == 0 ? a->below[1] : rest}});
  }

  static bool equal(const Link& a, const Link& b) {
    if (a == b) return true;
    if (a == nullptr || b == nullptr || a->id != b->id || a->branch != b->branch) return false;
    return a->branch == 0 || (equal(a->below[0], b->below[0]) && equal(a->below[1], b->below[1]));
  }

  Link root_;
};

}  // namespace twinshade::spirv
