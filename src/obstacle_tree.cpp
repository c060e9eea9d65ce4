// Based on: Goldsmith, Salmon, "Automatic Creation of Object Hierarchies for Ray Tracing", 1987 (insertion by the least
// growth of area); Kensler, "Tree Rotations for Improving Bounding Volume Hierarchies", 2008; Wald, "On fast
// Construction of SAH-based Bounding Volume Hierarchies", 2007 (bins). Heights are kept level besides, as in AVL trees.
#include "obstacle_tree.h"

#include "elastoon/assert.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace elastoon {

namespace {

/// By how much the heights of two siblings may differ. More slack lets areas rule; this much keeps the depth below
/// about 3 log2(n).
constexpr int kMostLean = 3;
constexpr std::size_t kMostIndex = 0x7fffffff;

bool isSound(const Box& box) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!(std::isfinite(box.low[axis]) && std::isfinite(box.high[axis]) && box.low[axis] <= box.high[axis])) {
            return false;
        }
    }
    return true;
}

/// Half of the surface, which a random line's chance to meet the box goes by, and a little of the diagonal's square, so
/// that points in a row are told apart too.
double areaOf(const Box& box) {
    const Vec3 size = box.high - box.low;
    return size.x * size.y + size.y * size.z + size.z * size.x + 0.01 * glm::dot(size, size);
}

double unionArea(const Box& a, const Box& b) {
    return areaOf(unionOf(a, b));
}

} // namespace

int ObstacleTree::makeNode() {
    if (free_.empty()) {
        nodes_.emplace_back();
        return static_cast<int>(nodes_.size()) - 1;
    }
    const int node = free_.back();
    free_.pop_back();
    at(node) = Node{};
    return node;
}

int ObstacleTree::makeInner() {
    const int node = makeNode();
    if (free_forks_.empty()) {
        at(node).index = static_cast<std::uint32_t>(forks_.size());
        forks_.emplace_back();
    } else {
        at(node).index = free_forks_.back();
        free_forks_.pop_back();
    }
    return node;
}

void ObstacleTree::freeInner(int node) {
    free_forks_.push_back(at(node).index);
    free_.push_back(node);
}

int ObstacleTree::makeLeaf(std::size_t index, const Box& box) {
    const int leaf = makeNode();
    at(leaf).box = box;
    at(leaf).index = static_cast<std::uint32_t>(index);
    if (leaf_of_.size() <= index) {
        leaf_of_.resize(index + 1, kNone);
    }
    leaf_of_[index] = leaf;
    ++count_;
    return leaf;
}

bool ObstacleTree::contains(std::size_t index) const {
    return index < leaf_of_.size() && leaf_of_[index] != kNone;
}

void ObstacleTree::setParent(int child, int parent) {
    at(child).parent = parent;
}

void ObstacleTree::setChild(int parent, int slot, int child) {
    at(parent).children[slot] = child;
    setParent(child, parent);
}

void ObstacleTree::replaceChild(int parent, int old_child, int new_child) {
    if (parent == kNone) {
        root_ = new_child;
        setParent(new_child, kNone);
    } else {
        setChild(parent, at(parent).children[0] == old_child ? 0 : 1, new_child);
    }
}

void ObstacleTree::refit(int node) {
    Node& here = at(node);
    const Node& a = at(here.children[0]);
    const Node& b = at(here.children[1]);
    here.box = unionOf(a.box, b.box);
    here.height = 1 + std::max(a.height, b.height);
    Fork& fork = forks_[here.index];
    fork = Fork{};
    for (const int child : here.children) {
        if (at(child).isLeaf()) {
            fork.add(readAs(child), outwards(at(child).box));
            continue;
        }
        for (const int grandchild : at(child).children) {
            fork.add(readAs(grandchild), outwards(at(grandchild).box));
        }
    }
}

ObstacleTree::Fork::Fork() {
    constexpr float kFar = std::numeric_limits<float>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis].fill(kFar);
        high[axis].fill(-kFar);
    }
}

void ObstacleTree::Fork::add(int what, const FloatBox& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis][count] = box.low[axis];
        high[axis][count] = box.high[axis];
    }
    below[count++] = what;
}

unsigned ObstacleTree::Fork::meeting(const FloatBox& box) const {
    using Four [[gnu::vector_size(16)]] = float;
    using FourInts [[gnu::vector_size(16)]] = int;
    FourInts apart{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Four lows, highs;
        std::memcpy(&lows, low[axis].data(), sizeof lows);
        std::memcpy(&highs, high[axis].data(), sizeof highs);
        apart |= (lows > box.high[axis]) | (highs < box.low[axis]);
    }
    const FourInts bits = ~apart & FourInts{1, 2, 4, 8};
    return static_cast<unsigned>((bits[0] | bits[1]) | (bits[2] | bits[3]));
}

ObstacleTree::FloatBox ObstacleTree::outwards(const Box& box) {
    constexpr double kMost = std::numeric_limits<float>::max();
    // More than the nearest float is off, also where that is not normal.
    constexpr double kShare = std::numeric_limits<float>::epsilon();
    constexpr double kLeast = std::numeric_limits<float>::min();
    FloatBox coarse{};
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        const double low = box.low[axis] - (kShare * std::fabs(box.low[axis]) + kLeast);
        const double high = box.high[axis] + (kShare * std::fabs(box.high[axis]) + kLeast);
        constexpr float kFar = std::numeric_limits<float>::infinity();
        coarse.low[i] = low >= -kMost ? static_cast<float>(std::min(low, kMost)) : -kFar;
        coarse.high[i] = high <= kMost ? static_cast<float>(std::max(high, -kMost)) : kFar;
    }
    return coarse;
}

/// Where a new leaf adds the least area to the tree: descends as long as a child promises less than stopping.
int ObstacleTree::bestSibling(const Box& box) const {
    int node = root_;
    while (!at(node).isLeaf()) {
        const Node& here = at(node);
        const double with_box = unionArea(here.box, box);
        const double growth = with_box - areaOf(here.box);
        double costs[2];
        for (int slot = 0; slot < 2; ++slot) {
            const Node& child = at(here.children[slot]);
            costs[slot] = growth + unionArea(child.box, box) - (child.isLeaf() ? 0.0 : areaOf(child.box));
        }
        if (with_box < costs[0] && with_box < costs[1]) {
            break;
        }
        const bool level = costs[0] == costs[1];
        const bool second = level ? at(here.children[1]).height < at(here.children[0]).height : costs[1] < costs[0];
        node = here.children[second ? 1 : 0];
    }
    return node;
}

void ObstacleTree::addLeaf(int leaf) {
    if (root_ == kNone) {
        root_ = leaf;
        setParent(leaf, kNone);
        return;
    }
    const int sibling = bestSibling(at(leaf).box);
    const int above = at(sibling).parent;
    const int parent = makeInner();
    replaceChild(above, sibling, parent);
    setChild(parent, 0, sibling);
    setChild(parent, 1, leaf);
    refitUpwards(parent);
}

void ObstacleTree::dropLeaf(int leaf) {
    const int parent = at(leaf).parent;
    if (parent == kNone) {
        root_ = kNone;
        return;
    }
    const int sibling = at(parent).children[at(parent).children[0] == leaf ? 1 : 0];
    const int above = at(parent).parent;
    replaceChild(above, parent, sibling);
    freeInner(parent);
    refitUpwards(above);
}

void ObstacleTree::refitUpwards(int node) {
    while (node != kNone) {
        refit(node);
        balance(node);
        rotate(node);
        node = at(node).parent;
    }
}

/// Exchanges a child of the node with a grandchild under the other child.
void ObstacleTree::exchange(int node, int child, int grandchild) {
    const int uncle = at(grandchild).parent;
    const int slot = at(uncle).children[0] == grandchild ? 0 : 1;
    setChild(node, at(node).children[0] == child ? 0 : 1, grandchild);
    setChild(uncle, slot, child);
    refit(uncle);
    refit(node);
}

/// Where one child is much higher than the other, its higher child goes up in exchange for the lower one.
void ObstacleTree::balance(int node) {
    for (;;) {
        const int* children = at(node).children;
        const int lean = at(children[1]).height - at(children[0]).height;
        if (std::abs(lean) <= kMostLean) {
            return;
        }
        const int high = children[lean > 0 ? 1 : 0];
        const int low = children[lean > 0 ? 0 : 1];
        const int* grandchildren = at(high).children;
        const bool second = at(grandchildren[1]).height > at(grandchildren[0]).height;
        exchange(node, low, grandchildren[second ? 1 : 0]);
    }
}

/// The exchange of a child with a grandchild that saves the most area, if one does and the heights stay level.
void ObstacleTree::rotate(int node) {
    double most_saved = 0.0;
    int best_child = kNone;
    int best_grandchild = kNone;
    for (int slot = 0; slot < 2; ++slot) {
        const int child = at(node).children[slot];
        const Node& uncle = at(at(node).children[1 - slot]);
        if (uncle.isLeaf()) {
            continue;
        }
        for (int lower = 0; lower < 2; ++lower) {
            const Node& up = at(uncle.children[lower]);
            const Node& stays = at(uncle.children[1 - lower]);
            const int height = 1 + std::max(at(child).height, stays.height);
            const double saved = areaOf(uncle.box) - unionArea(at(child).box, stays.box);
            if (saved > most_saved && std::abs(height - up.height) <= kMostLean &&
                std::abs(at(child).height - stays.height) <= kMostLean) {
                most_saved = saved;
                best_child = child;
                best_grandchild = uncle.children[lower];
            }
        }
    }
    if (best_child != kNone) {
        exchange(node, best_child, best_grandchild);
    }
}

void ObstacleTree::insert(std::size_t index, const Box& box) {
    const bool possible = isSound(box) && index <= kMostIndex && !contains(index);
    ELASTOON_ASSERT(possible, "a box must be finite, low <= high, and its index new");
    if (possible) {
        addLeaf(makeLeaf(index, box));
    }
}

void ObstacleTree::update(std::size_t index, const Box& box) {
    const bool possible = isSound(box) && contains(index);
    ELASTOON_ASSERT(possible, "a box must be finite, low <= high, and its index in the tree");
    if (!possible) {
        return;
    }
    const int leaf = leaf_of_[index];
    if (at(leaf).box.low == box.low && at(leaf).box.high == box.high) {
        return;
    }
    dropLeaf(leaf);
    at(leaf).box = box;
    addLeaf(leaf);
}

bool ObstacleTree::remove(std::size_t index) {
    if (!contains(index)) {
        return false;
    }
    dropLeaf(leaf_of_[index]);
    free_.push_back(leaf_of_[index]);
    leaf_of_[index] = kNone;
    --count_;
    return true;
}

void ObstacleTree::meeting(const Box& box, std::vector<std::size_t>& found) const {
    found.clear();
    query(box, [&](std::size_t index) { found.push_back(index); });
    std::sort(found.begin(), found.end());
}

void ObstacleTree::clear() {
    *this = ObstacleTree{};
}

void ObstacleTree::build(std::span<const IndexedBox> boxes) {
    clear();
    std::vector<const IndexedBox*> order;
    for (const IndexedBox& given : boxes) {
        order.push_back(&given);
    }
    std::sort(order.begin(), order.end(), [](const auto* a, const auto* b) { return a->index < b->index; });
    std::vector<int> leaves;
    for (const IndexedBox* given : order) {
        const bool possible = isSound(given->box) && given->index <= kMostIndex && !contains(given->index);
        ELASTOON_ASSERT(possible, "a box must be finite, low <= high, and its index new");
        if (possible) {
            leaves.push_back(makeLeaf(given->index, given->box));
        }
    }
    nodes_.reserve(2 * leaves.size());
    forks_.reserve(leaves.size());
    if (!leaves.empty()) {
        split(leaves, kNone, 0);
    }
    // Parents were made before their children, after all leaves.
    for (int node = static_cast<int>(nodes_.size()) - 1; node >= static_cast<int>(count_); --node) {
        refit(node);
    }
}

namespace {

/// Which bin of an axis a box belongs to, by its middle.
struct Bins {
    static constexpr int kCount = 16;
    int axis = 0;
    double low = 0.0;
    double scale = 0.0;

    [[nodiscard]] int of(const Box& box) const {
        const double middle = 0.5 * box.low[axis] + 0.5 * box.high[axis];
        return std::clamp(static_cast<int>((middle - low) * scale), 0, kCount - 1);
    }
};

struct Cut {
    Bins bins;
    int last = -1; ///< bin on the near side; -1: no cut separates anything
    double cost = 0.0;
};

struct Pile {
    Box box;
    double count = 0.0;

    void add(const Pile& other) {
        if (other.count > 0.0) {
            box = count > 0.0 ? unionOf(box, other.box) : other.box;
            count += other.count;
        }
    }
    [[nodiscard]] double cost() const { return count > 0.0 ? count * areaOf(box) : 0.0; }
};

/// The cut between two bins with the least expected work: count times area, on both sides.
void tryCuts(const std::array<Pile, Bins::kCount>& piles, const Bins& bins, Cut& best) {
    std::array<double, Bins::kCount> beyond{};
    Pile far_side;
    for (int bin = Bins::kCount - 1; bin > 0; --bin) {
        far_side.add(piles[static_cast<std::size_t>(bin)]);
        beyond[static_cast<std::size_t>(bin)] = far_side.count > 0.0 ? far_side.cost() : -1.0;
    }
    Pile near_side;
    for (int bin = 0; bin + 1 < Bins::kCount; ++bin) {
        near_side.add(piles[static_cast<std::size_t>(bin)]);
        const double rest = beyond[static_cast<std::size_t>(bin) + 1];
        if (near_side.count == 0.0 || rest < 0.0) {
            continue;
        }
        const double cost = near_side.cost() + rest;
        if (best.last < 0 || cost < best.cost) {
            best = {bins, bin, cost};
        }
    }
}

} // namespace

void ObstacleTree::split(std::span<int> leaves, int parent, int slot) {
    struct Part {
        std::span<int> leaves;
        int parent, slot;
    };
    std::vector<Part> todo{{leaves, parent, slot}};
    while (!todo.empty()) {
        const Part part = todo.back();
        todo.pop_back();
        const int node = part.leaves.size() == 1 ? part.leaves[0] : makeInner();
        if (part.parent == kNone) {
            root_ = node;
            setParent(node, kNone);
        } else {
            setChild(part.parent, part.slot, node);
        }
        if (part.leaves.size() == 1) {
            continue;
        }
        const auto middleOf = [&](int leaf) { return 0.5 * at(leaf).box.low + 0.5 * at(leaf).box.high; };
        Box middles{middleOf(part.leaves[0]), middleOf(part.leaves[0])};
        for (const int leaf : part.leaves) {
            middles = unionOf(middles, {middleOf(leaf), middleOf(leaf)});
        }
        Cut cut;
        for (int axis = 0; axis < 3; ++axis) {
            const double size = middles.high[axis] - middles.low[axis];
            if (!(size > 0.0) || !std::isfinite(Bins::kCount / size)) {
                continue;
            }
            const Bins bins{axis, middles.low[axis], Bins::kCount / size};
            std::array<Pile, Bins::kCount> piles{};
            for (const int leaf : part.leaves) {
                piles[static_cast<std::size_t>(bins.of(at(leaf).box))].add({at(leaf).box, 1.0});
            }
            tryCuts(piles, bins, cut);
        }
        auto middle = part.leaves.begin() + static_cast<std::ptrdiff_t>(part.leaves.size() / 2);
        if (cut.last >= 0) {
            middle = std::stable_partition(part.leaves.begin(), part.leaves.end(),
                                           [&](int leaf) { return cut.bins.of(at(leaf).box) <= cut.last; });
        }
        const auto near_count = static_cast<std::size_t>(middle - part.leaves.begin());
        todo.push_back({part.leaves.first(near_count), node, 0});
        todo.push_back({part.leaves.subspan(near_count), node, 1});
    }
}

/// Separating axes of a segment against a box (Akenine-Moeller et al., "Real-Time Rendering", section 22.8): the
/// moving box's size is added to the other's.
bool ObstacleTree::sweepMeets(const Box& box, const Vec3& way, const Box& other) {
    const Vec3 half_way = 0.5 * way;
    const Vec3 reach = 0.5 * (other.high - other.low) + 0.5 * (box.high - box.low);
    const Vec3 apart = (0.5 * box.low + 0.5 * box.high) + half_way - (0.5 * other.low + 0.5 * other.high);
    // What rounding may do to the sides of the comparisons.
    constexpr double kSlack = 1e-14;
    const Vec3 magnitude =
        glm::max(glm::max(glm::abs(box.low), glm::abs(box.high)), glm::max(glm::abs(other.low), glm::abs(other.high))) +
        glm::abs(way);
    const Vec3 limit = reach + kSlack * magnitude;
    const Vec3 along = glm::abs(half_way);
    for (int axis = 0; axis < 3; ++axis) {
        if (std::fabs(apart[axis]) > limit[axis] + along[axis]) {
            return false;
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        const int j = (axis + 1) % 3;
        const int k = (axis + 2) % 3;
        if (std::fabs(half_way[j] * apart[k] - half_way[k] * apart[j]) > along[j] * limit[k] + along[k] * limit[j]) {
            return false;
        }
    }
    return true;
}

} // namespace elastoon
