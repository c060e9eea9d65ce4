// Which obstacles may be near: a tree of axis-aligned boxes.
#pragma once

#include "elastoon/math.h"
#include "large_array.h"

#include <array>
#include <bit>
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
        return walk([&](const Fork& fork) { return fork.meeting(around); },
                    [&](const Box& other) { return meet(box, other); }, visitor);
    }
    /// The same for a box that moves from where it is along `way` in a straight line: for ways that are long and aslant
    /// it finds far fewer than the box around all of the way. Boxes within rounding of it may be found too.
    template <class Visitor>
    std::size_t sweep(const Box& box, const Vec3& way, Visitor&& visitor) const {
        const auto meets = [&](const Box& other) { return sweepMeets(box, way, other); };
        const auto mayMeet = [&](const Fork& fork) {
            unsigned some = 0;
            for (std::size_t i = 0; i < fork.count; ++i) {
                some |= (meets(wide(fork.box(i))) ? 1U : 0U) << i;
            }
            return some;
        };
        return walk(mayMeet, meets, visitor);
    }
    /// The indices whose boxes meet this one, ascending, in place of what `found` held.
    void meeting(const Box& box, std::vector<std::size_t>& found) const;

private:
    static constexpr int kNone = -1;

    struct Node {
        Box box;
        int parent = kNone;
        int children[2] = {kNone, kNone}; ///< none: a leaf
        int height = 0; ///< of a leaf 0
        std::uint32_t index = 0; ///< of a leaf its own; of others that of the fork

        [[nodiscard]] bool isLeaf() const { return children[0] == kNone; }
    };

    /// Coarser, but never smaller than what it stands for.
    struct FloatBox {
        std::array<float, 3> low, high;
    };
    static constexpr std::size_t kFork = 4;
    /// What a query reads of a node that is no leaf: what is two levels below it, side by side, in two lines of the
    /// cache. So it reads every other level alone.
    struct alignas(64) Fork {
        std::array<std::array<float, kFork>, 3> low, high;
        std::array<int, kFork> below{}; ///< their forks; of leaves the node's complement
        std::size_t count = 0;

        /// Nothing meets what is not there.
        Fork();
        void add(int what, const FloatBox& box);
        [[nodiscard]] FloatBox box(std::size_t i) const {
            return {{low[0][i], low[1][i], low[2][i]}, {high[0][i], high[1][i], high[2][i]}};
        }
        /// A bit for each that meets the box.
        [[nodiscard]] unsigned meeting(const FloatBox& box) const;
    };

    static FloatBox outwards(const Box& box);
    static Box wide(const FloatBox& box) {
        return {{box.low[0], box.low[1], box.low[2]}, {box.high[0], box.high[1], box.high[2]}};
    }
    /// As Fork::below has it.
    [[nodiscard]] int readAs(int node) const { return at(node).isLeaf() ? ~node : static_cast<int>(at(node).index); }
    static std::size_t asSize(int i) { return static_cast<std::size_t>(i); }
    static bool sweepMeets(const Box& box, const Vec3& way, const Box& other);
    Node& at(int node) { return nodes_[asSize(node)]; }
    [[nodiscard]] const Node& at(int node) const { return nodes_[asSize(node)]; }

    int makeNode();
    int makeInner();
    void freeInner(int node);
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

    /// Asked for as soon as it is known that it will be read: of a large tree it is in no cache.
    void fetch([[maybe_unused]] int below) const {
#if !defined(__wasm__)
        if (below < 0) {
            __builtin_prefetch(&at(~below));
        } else {
            __builtin_prefetch(&forks_[asSize(below)]);
            __builtin_prefetch(&forks_[asSize(below)].below);
        }
#endif
    }

    /// What is far is told by the coarse boxes, what is found by the exact ones.
    template <class MayMeet, class Meets, class Visitor>
    std::size_t walk(MayMeet&& may_meet, Meets&& meets, Visitor&& visitor) const {
        std::size_t looked_at = 0;
        if (root_ != kNone) {
            walkFrom(readAs(root_), may_meet, meets, visitor, looked_at);
        }
        return looked_at;
    }

    /// False where the visitor stops the query.
    template <class MayMeet, class Meets, class Visitor>
    bool walkFrom(int from, MayMeet&& may_meet, Meets&& meets, Visitor&& visitor, std::size_t& looked_at) const {
        std::array<int, 64> open; // enough, but for strange trees
        std::size_t count = 0;
        open[count++] = from;
        while (count > 0) {
            const int here = open[--count];
            ++looked_at;
            if (here < 0) {
                const Node& leaf = at(~here);
                if (meets(leaf.box) && !goesOn(visitor, leaf.index)) {
                    return false;
                }
                continue;
            }
            const Fork& fork = forks_[asSize(here)];
            for (unsigned some = may_meet(fork); some != 0; some &= some - 1) {
                const int below = fork.below[asSize(std::countr_zero(some))];
                if (count < open.size()) {
                    fetch(below);
                    open[count++] = below;
                } else if (!walkFrom(below, may_meet, meets, visitor, looked_at)) {
                    return false;
                }
            }
        }
        return true;
    }
    template <class Visitor>
    static bool goesOn(Visitor&& visitor, std::size_t index) {
        if constexpr (std::is_void_v<decltype(visitor(index))>) {
            visitor(index);
            return true;
        } else {
            return visitor(index);
        }
    }

    LargeArray<Node> nodes_;
    LargeArray<Fork> forks_;
    std::vector<int> free_;
    std::vector<std::uint32_t> free_forks_;
    LargeArray<int> leaf_of_; ///< by index
    int root_ = kNone;
    std::size_t count_ = 0;
};

} // namespace elastoon
