// The tree against brute force, under seeded changes.
#include "obstacle_tree.h"

#include "test_support.h"

#include "elastoon/assert.h"

#include <algorithm>
#include <limits>
#include <map>

namespace elastoon {
namespace {

using Boxes = std::map<std::size_t, Box>;

Box around(const Vec3& middle, const Vec3& half) {
    return {middle - half, middle + half};
}

/// Mostly small boxes, some long or huge, some points, many of the same place.
Box randomBox(Random& random) {
    const Vec3 middle = random.below(5) == 0 ? Vec3(random.below(3), random.below(3), 0.0) : random.inBox(100.0);
    const double scale = std::pow(10.0, random.uniform(-3.0, random.below(10) == 0 ? 2.0 : 0.7));
    Vec3 half = glm::abs(random.inBox(scale));
    if (random.below(8) == 0) {
        half[random.below(3)] *= 1e3;
    }
    return around(middle, random.below(10) == 0 ? Vec3(0.0) : half);
}

std::vector<std::size_t> byBruteForce(const Boxes& boxes, const Box& box) {
    std::vector<std::size_t> found;
    for (const auto& [index, other] : boxes) {
        if (meet(box, other)) {
            found.push_back(index);
        }
    }
    return found;
}

std::vector<IndexedBox> listOf(const Boxes& boxes) {
    std::vector<IndexedBox> list;
    for (const auto& [index, box] : boxes) {
        list.push_back({index, box});
    }
    return list;
}

/// Every query finds what brute force finds, each index once.
void expectSame(const ObstacleTree& tree, const Boxes& boxes, Random& random, int queries, std::size_t& found_in_all) {
    ASSERT_EQ(tree.size(), boxes.size());
    std::vector<std::size_t> found;
    for (int i = 0; i < queries; ++i) {
        const Box box = randomBox(random);
        tree.meeting(box, found);
        ASSERT_EQ(found, byBruteForce(boxes, box));
        found_in_all += found.size();
    }
}

TEST(ObstacleTree, FindsWhatBruteForceFindsUnderAnyChanges) {
    Random random(71);
    std::size_t found = 0;
    for (int run = 0; run < 6 * soak(); ++run) {
        ObstacleTree tree;
        Boxes boxes;
        for (int change = 0; change < 1500; ++change) {
            const auto index = static_cast<std::size_t>(random.below(400));
            const bool there = boxes.count(index) != 0;
            ASSERT_EQ(tree.contains(index), there);
            if (random.below(3) == 0) {
                EXPECT_EQ(tree.remove(index), there);
                boxes.erase(index);
            } else {
                Box box = randomBox(random);
                if (there && random.below(2) == 0) {
                    box = around(0.5 * (boxes[index].low + boxes[index].high) + random.inBox(0.1), Vec3(1.0));
                }
                there ? tree.update(index, box) : tree.insert(index, box);
                boxes[index] = box;
            }
            if (change % 250 == 0) {
                expectSame(tree, boxes, random, 30, found);
            }
        }
        expectSame(tree, boxes, random, 100, found);
        tree.build(listOf(boxes));
        expectSame(tree, boxes, random, 100, found);
        for (const auto& [index, box] : listOf(boxes)) {
            EXPECT_TRUE(tree.remove(index));
            EXPECT_FALSE(tree.remove(index));
        }
        EXPECT_EQ(tree.size(), 0U);
        EXPECT_EQ(tree.query(around(Vec3(0.0), Vec3(1e9)), [](std::size_t) { ADD_FAILURE(); }), 0U);
    }
    EXPECT_GT(found, 2000U) << "the queries must hit something";
}

TEST(ObstacleTree, SweepFindsAllThatTheMovingBoxMeets) {
    Random random(72);
    std::size_t swept = 0;
    std::size_t boxed = 0;
    for (int run = 0; run < 20 * soak(); ++run) {
        Boxes boxes;
        for (std::size_t i = 0; i < 300; ++i) {
            boxes[i] = around(random.inBox(50.0), glm::abs(random.inBox(8.0)));
        }
        ObstacleTree tree;
        tree.build(listOf(boxes));
        const Box box = around(random.inBox(50.0), glm::abs(random.inBox(1.0)));
        const Vec3 way = -1.3 * box.low + random.inBox(30.0);
        std::vector<bool> found(300, false);
        tree.sweep(box, way, [&](std::size_t index) { found[index] = true; });
        for (int i = 0; i <= 500; ++i) {
            const Vec3 part = way * (i / 500.0);
            for (const std::size_t index : byBruteForce(boxes, {box.low + part, box.high + part})) {
                EXPECT_TRUE(found[index]);
            }
        }
        const Box around_all = unionOf(box, {box.low + way, box.high + way});
        for (std::size_t i = 0; i < 300; ++i) {
            swept += found[i] ? 1 : 0;
            EXPECT_TRUE(!found[i] || meet(around_all, Box{boxes[i].low - 1e-9, boxes[i].high + 1e-9}));
        }
        boxed += byBruteForce(boxes, around_all).size();
    }
    EXPECT_GT(swept, 40U);
    EXPECT_LT(swept, boxed / 2) << "a sweep aslant must find far fewer than its box";
}

TEST(ObstacleTree, BuildDoesNotDependOnTheOrderGiven) {
    Random random(73);
    std::vector<IndexedBox> boxes;
    for (std::size_t i = 0; i < 500; ++i) {
        boxes.push_back({i, randomBox(random)});
    }
    ObstacleTree tree;
    tree.build(boxes);
    std::reverse(boxes.begin(), boxes.end());
    std::swap(boxes[3], boxes[200]);
    ObstacleTree other;
    other.build(boxes);
    const auto visitsOf = [](const ObstacleTree& of) {
        std::vector<std::size_t> visits;
        visits.push_back(of.query(around(Vec3(0.0), Vec3(60.0)), [&](std::size_t index) { visits.push_back(index); }));
        return visits;
    };
    EXPECT_GT(visitsOf(tree).size(), 50U);
    EXPECT_EQ(visitsOf(tree), visitsOf(other));
}

TEST(ObstacleTree, VisitorMayStop) {
    ObstacleTree tree;
    for (std::size_t i = 0; i < 100; ++i) {
        tree.insert(i, around(Vec3(0.0), Vec3(1.0)));
    }
    int visits = 0;
    tree.query(around(Vec3(0.0), Vec3(1.0)), [&](std::size_t) { return ++visits < 7; });
    EXPECT_EQ(visits, 7);
}

/// Mean number of nodes that queries the size of an obstacle look at, where about one obstacle is found.
double nodesPerQuery(const ObstacleTree& tree, double half_size) {
    Random random(74);
    std::size_t looked_at = 0;
    for (int i = 0; i < 1000; ++i) {
        looked_at += tree.query(around(random.inBox(half_size), Vec3(0.5)), [](std::size_t) {});
    }
    return static_cast<double>(looked_at) / 1000.0;
}

TEST(ObstacleTree, LooksAtFewNodesAmongAHundredThousand) {
    Random random(75);
    constexpr double kHalfSize = 50.0; // a hundred thousand boxes of about 1 m in 100 m each way: a tenth is filled
    std::vector<IndexedBox> boxes;
    ObstacleTree one_by_one;
    for (std::size_t i = 0; i < 100000; ++i) {
        boxes.push_back({i, around(random.inBox(kHalfSize), Vec3(0.5))});
        one_by_one.insert(i, boxes.back().box);
    }
    ObstacleTree at_once;
    at_once.build(boxes);
    EXPECT_LT(nodesPerQuery(at_once, kHalfSize), 150.0);
    EXPECT_LT(nodesPerQuery(one_by_one, kHalfSize), 200.0);
    // Most move on by about their size: the tree must not decay.
    for (std::size_t i = 0; i < 70000; ++i) {
        const Vec3 by = random.inBox(1.0);
        one_by_one.update(i, {boxes[i].box.low + by, boxes[i].box.high + by});
    }
    EXPECT_LT(nodesPerQuery(one_by_one, kHalfSize), 200.0);
    EXPECT_LT(one_by_one.depth(), 50);
}

TEST(ObstacleTree, StaysLevelWhereAreasSayNothing) {
    ObstacleTree row;
    ObstacleTree stack;
    ObstacleTree nest;
    for (std::size_t i = 0; i < 20000; ++i) {
        row.insert(i, around(Vec3(static_cast<double>(i), 0.0, 0.0), Vec3(0.0)));
        stack.insert(i, around(Vec3(1.0), Vec3(1.0)));
        nest.insert(i, around(Vec3(0.0), Vec3(1.0 + static_cast<double>(i))));
    }
    EXPECT_LT(row.depth(), 50);
    EXPECT_LT(stack.depth(), 50);
    EXPECT_LT(nest.depth(), 50);
    EXPECT_LT(row.query(around(Vec3(7000.3, 0.0, 0.0), Vec3(1.0)), [](std::size_t) {}), 200U);
}

int failures_told = 0;

TEST(ObstacleTree, RefusesWhatIsNoBox) {
    const AssertHandler before = setAssertHandler([](const char*, const char*, const char*, int) { ++failures_told; });
    ObstacleTree tree;
    tree.insert(3, around(Vec3(0.0), Vec3(1.0)));
    failures_told = 0;
    const double none = std::numeric_limits<double>::quiet_NaN();
    const double infinite = std::numeric_limits<double>::infinity();
    tree.insert(1, {Vec3(0.0), Vec3(1.0, none, 1.0)});
    tree.insert(1, {Vec3(-infinite, 0.0, 0.0), Vec3(1.0)});
    tree.insert(1, {Vec3(1.0), Vec3(0.0)});
    tree.insert(3, around(Vec3(0.0), Vec3(1.0)));
    tree.update(2, around(Vec3(0.0), Vec3(1.0)));
    tree.update(3, {Vec3(none), Vec3(1.0)});
    EXPECT_EQ(failures_told, 6);
    EXPECT_EQ(tree.size(), 1U);
    tree.build(std::vector<IndexedBox>{{4, around(Vec3(0.0), Vec3(1.0))}, {4, around(Vec3(0.0), Vec3(1.0))}});
    EXPECT_EQ(failures_told, 7);
    EXPECT_EQ(tree.size(), 1U);
    setAssertHandler(before);
}

} // namespace
} // namespace elastoon
