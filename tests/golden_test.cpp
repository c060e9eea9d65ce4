// The golden scenes together use every phase, event and rule of contact: what none of them shows, no hash protects.
#include "golden/golden_run.h"
#include "test_support.h"

#include <map>
#include <set>

namespace elastoon {
namespace {

const std::string kSource = ELASTOON_SOURCE_DIR;

/// How often something is seen, by its name.
using Counts = std::map<std::string, int>;

void countObstacles(const Scene& scene, Counts& counts) {
    for (const SceneObstacle& obstacle : scene.obstacles) {
        counts["path"] += obstacle.def.path.empty() ? 0 : 1;
        counts["path that repeats"] += obstacle.def.path_repeats ? 1 : 0;
        counts["turning obstacle"] += obstacle.def.angular_velocity != Vec3(0.0) ? 1 : 0;
        counts["solid"] += obstacle.def.shape ? 1 : 0;
    }
}

/// An impact that ends in an impact with another obstacle at once: that one had waited.
bool follows(const Phase& first, const Phase& second) {
    return first.is<Impact>() && second.is<Impact>() && first.obstacle != second.obstacle && second.start == first.end;
}

void countTrack(const Track& track, const Style& style, Counts& counts) {
    for (std::size_t i = 0; i < track.phases().size(); ++i) {
        const Phase& phase = track.phases()[i];
        ++counts["phase " + std::string(nameOf(phase))];
        const auto* impact = phase.as<Impact>();
        counts["skip"] += impact != nullptr && impact->skims != Vec3(0.0) ? 1 : 0;
        for (const KeptClear& kept : phase.clear_of) {
            counts["blended corner"] += impact != nullptr && style.corner_rule == CornerRule::Blended ? 1 : 0;
            counts["press"] += kept.presses ? 1 : 0;
        }
        const bool queued = i > 0 && style.corner_rule == CornerRule::Queued && follows(track.phases()[i - 1], phase);
        counts["queued corner"] += queued ? 1 : 0;
    }
}

Counts countScene(const Golden& golden) {
    Counts counts;
    Timeline timeline;
    bool begun = false;
    const StagedScene ended =
        valueOf(runGolden(golden, kSource + "/scenes", [&](const Scene& scene, const StagedScene& staged) {
            if (begun) {
                timeline.capture(staged.world);
            } else {
                timeline.begin(staged.world);
                countObstacles(scene, counts);
                counts["no gravity"] += scene.gravity == Vec3(0.0) ? 1 : 0;
            }
            begun = true;
        }));
    EXPECT_EQ(ended.world.stateHash(), golden.hash) << golden.scene << " at " << golden.fps;
    for (const Track& track : timeline.tracks()) {
        countTrack(track, ended.world.style(track.body()), counts);
    }
    for (const Event& event : timeline.events()) {
        ++counts["event " + std::string(nameOf(event.type))];
    }
    return counts;
}

TEST(Golden, ScenesShowEveryPhaseEventAndRule) {
    Counts counts;
    std::set<std::string> scenes;
    for (const Golden& golden : valueOf(readGoldens(kSource + "/tests/golden/hashes.txt"))) {
        if (scenes.insert(golden.scene).second) {
            for (const auto& [what, count] : countScene(golden)) {
                counts[what] += count;
            }
        }
    }
    EXPECT_GE(scenes.size(), 6U);
    std::string all;
    for (const auto& [what, count] : counts) {
        all += what + " " + std::to_string(count) + ", ";
    }
    for (const char* what :
         {"phase flight", "phase impact", "phase rest", "phase slide", "event impact", "event release", "event rest",
          "event wake", "event squeeze", "queued corner", "blended corner", "skip", "press", "path",
          "path that repeats", "turning obstacle", "solid", "no gravity"}) {
        EXPECT_GE(counts[what], 1) << what << " is in none of the scenes: " << all;
    }
    RecordProperty("seen", all);
}

TEST(Golden, DamagedListsAreRefused) {
    EXPECT_FALSE(readGoldens("/no/such/hashes.txt").ok());
    EXPECT_FALSE(readGoldens(kSource + "/README.md").ok());
    EXPECT_FALSE(runGolden({"no-such.json", 60.0, 0}, kSource + "/scenes").ok());
}

} // namespace
} // namespace elastoon
