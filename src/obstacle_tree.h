// Which obstacles may be near: a tree of axis-aligned boxes.
#pragma once

#include "elastoon/math.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace elastoon {

/// All points with low <= point <= high, along each axis.
struct Box {
    Vec3 low{0.0};
    Vec3 high{0.0};
};

/// They share a point, if only on their border.
[[nodiscard]] inline bool meet(const Box& a, const Box& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
           a.low.z <= b.high.z && b.low.z <= a.high.z;
}
[[nodiscard]] inline Box unionOf(const Box& a, const Box& b) {
    return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

struct IndexedBox {
    std::size_t index = 0;
    Box box;
};

/// Boxes under indices (small numbers: slots), with their neighbourhoods. A query looks at about log(n) nodes besides
/// those that it finds. Queries may run at the same time; changes may not.
///
/// What is found depends on the boxes alone. The order of visits also depends on the changes before, so results that
/// depend on the order are to be sorted by index: meeting() does.
class ObstacleTree {
public:
    /// The boxes must be finite, low <= high; an index must not be there twice. Else it asserts and does nothing.
    void insert(std::size_t index, const Box& box);
    /// Gives the index a new box. It must be there.
    void update(std::size_t index, const Box& box);
    /// False if it is not there.
    bool remove(std::size_t index);
    /// These boxes instead of all that were there: quicker than one by one, and the same tree whatever their order.
    void build(std::span<const IndexedBox> boxes);
    void clear();

    [[nodiscard]] bool contains(std::size_t index) const;
    /// The box of an index that is there.
    [[nodiscard]] const Box& box(std::size_t index) const { return nodes_[asSize(leaf_of_[index])].box; }
    [[nodiscard]] std::size_t size() const { return count_; }
    /// Number of nodes from the root to the furthest leaf.
    [[nodiscard]] int depth() const { return root_ == kNone ? 0 : nodes_[asSize(root_)].height + 1; }

    /// Calls visitor(index) for every index whose box meets this one. A visitor that returns bool stops the query with
    /// false. Gives the number of nodes looked at.
    template <class Visitor>
    std::size_t query(const Box& box, Visitor&& visitor) const {
        const FloatBox around = outwards(box);
        return walk([&](const FloatBox& other) { return meet(around, other); },
                    [&](const Box& other) { return meet(box, other); }, visitor);
    }
    /// The same for a box that moves from where it is along `way` in a straight line: for ways that are long and aslant
    /// it finds far fewer than the box around all of the way. Boxes within rounding of it may be found too.
    template <class Visitor>
    std::size_t sweep(const Box& box, const Vec3& way, Visitor&& visitor) const {
        return walk([&](const FloatBox& other) { return sweepMeets(box, way, wide(other)); },
                    [&](const Box& other) { return sweepMeets(box, way, other); }, visitor);
    }
    /// The indices whose boxes meet this one, ascending, in place of what `found` held.
    void meeting(const Box& box, std::vector<std::size_t>& found) const {
        found.clear();
        query(box, [&](std::size_t index) { found.push_back(index); });
        std::sort(found.begin(), found.end());
    }

private:
    static constexpr int kNone = -1;

    struct Node {
        Box box;
        int parent = kNone;
        int children[2] = {kNone, kNone}; ///< none: a leaf
        int height = 0; ///< of a leaf 0
        std::uint32_t index = 0; ///< of a leaf

        [[nodiscard]] bool isLeaf() const { return children[0] == kNone; }
    };

    /// Coarser, but never smaller than what it stands for.
    struct FloatBox {
        std::array<float, 3> low, high;
    };
    /// What a query reads of a node that is no leaf: its two children, in one line of the cache.
    struct alignas(64) Fork {
        std::array<FloatBox, 2> boxes;
        std::array<int, 2> children; ///< of leaves the complement
        int parent;
    };

    static FloatBox outwards(const Box& box);
    static Box wide(const FloatBox& box) {
        return {{box.low[0], box.low[1], box.low[2]}, {box.high[0], box.high[1], box.high[2]}};
    }
    static bool meet(const Box& a, const Box& b) { return elastoon::meet(a, b); }
    /// Without a branch for each side: which of them tells two boxes apart cannot be foreseen.
    static bool meet(const FloatBox& a, const FloatBox& b) {
        bool apart = false;
        for (std::size_t i = 0; i < 3; ++i) {
            apart |= a.low[i] > b.high[i];
            apart |= b.low[i] > a.high[i];
        }
        return !apart;
    }
    static std::size_t asSize(int i) { return static_cast<std::size_t>(i); }
    static bool sweepMeets(const Box& box, const Vec3& way, const Box& other);
    Node& at(int node) { return nodes_[asSize(node)]; }
    [[nodiscard]] const Node& at(int node) const { return nodes_[asSize(node)]; }

    int makeNode();
    int makeLeaf(std::size_t index, const Box& box);
    [[nodiscard]] int bestSibling(const Box& box) const;
    void addLeaf(int leaf);
    void dropLeaf(int leaf);
    void refit(int node);
    void refitUpwards(int node);
    void setParent(int child, int parent);
    void setChild(int parent, int slot, int child);
    void replaceChild(int parent, int old_child, int new_child);
    void exchange(int node, int child, int grandchild);
    void balance(int node);
    void rotate(int node);
    void split(std::span<int> leaves, int parent, int slot);

    /// Both children are asked for before either is looked at: of a large tree they are in no cache.
    void fetchBelow([[maybe_unused]] const Fork& fork) const {
#if !defined(__wasm__)
        for (const int child : fork.children) {
            __builtin_prefetch(child >= 0 ? static_cast<const void*>(&forks_[asSize(child)]) : &at(~child));
        }
#endif
    }

    /// Goes over the tree from parent to child and back, so it needs no stack, however deep the tree is. What is far
    /// is told by the coarse boxes, what is found by the exact ones.
    template <class MayMeet, class Meets, class Visitor>
    std::size_t walk(MayMeet&& may_meet, Meets&& meets, Visitor&& visitor) const {
        std::size_t looked_at = 0;
        /// False where the visitor stops the query.
        const auto visit = [&](int leaf) {
            if (!meets(at(leaf).box)) {
                return true;
            }
            if constexpr (std::is_void_v<decltype(visitor(std::size_t{}))>) {
                visitor(static_cast<std::size_t>(at(leaf).index));
                return true;
            } else {
                return visitor(static_cast<std::size_t>(at(leaf).index));
            }
        };
        if (root_ != kNone && at(root_).isLeaf()) {
            visit(root_);
            return 1;
        }
        int node = root_;
        std::size_t slot = 0;
        while (node != kNone) {
            const Fork& fork = forks_[asSize(node)];
            if (slot == fork.boxes.size()) {
                const int below = node;
                node = fork.parent;
                slot = node != kNone && forks_[asSize(node)].children[0] == below ? 1 : 2;
                continue;
            }
            ++looked_at;
            if (slot == 0) {
                fetchBelow(fork);
            }
            const bool may = may_meet(fork.boxes[slot]);
            const int child = fork.children[slot];
            if (may && child >= 0) {
                node = child;
                slot = 0;
                continue;
            }
            if (may && !visit(~child)) {
                return looked_at;
            }
            ++slot;
        }
        return looked_at;
    }

    std::vector<Node> nodes_;
    std::vector<Fork> forks_; ///< by node; of leaves unused
    std::vector<int> free_;
    std::vector<int> leaf_of_; ///< by index
    int root_ = kNone;
    std::size_t count_ = 0;
};

} // namespace elastoon
