// Planted differences are found where they are, the earliest of them first.
#include "compare.h"

#include "test_support.h"

namespace elastoon {
namespace {

/// Two bodies in ten frames, and three events.
RecordedRun sample(RecordedRun::Kind kind = RecordedRun::Kind::Recording) {
    RecordedRun run;
    run.kind = kind;
    run.fps = 10.0;
    run.duration = 0.9;
    run.bodies = {"a", "b"};
    run.shapes = {"ball", "box"};
    run.pose_fields = {"px", "py", "pz", "qx", "qy", "qz", "qw", "stretch"};
    for (int frame = 0; frame < 10; ++frame) {
        run.times.push_back(frame / 10.0);
        for (int body = 0; body < 2; ++body) {
            run.poses.push_back({"flight", {1.0 * frame, 2.0 * body, 3.0, 0.0, 0.0, 0.0, 1.0, 1.5}});
        }
    }
    for (const double time : {0.25, 0.4, 0.65}) {
        run.events.push_back({time, "impact", "b", "floor", std::vector<double>(12, time)});
    }
    return run;
}

Comparison compared(const RecordedRun& first, const RecordedRun& second) {
    return valueOf(compareRuns(first, second));
}

TEST(Compare, EqualRunsAreEqual) {
    EXPECT_FALSE(compared(sample(), sample()).earliest);
    RecordedRun signed_zero = sample();
    signed_zero.poses[0].numbers[3] = -0.0;
    EXPECT_FALSE(compared(sample(), signed_zero).earliest);
}

TEST(Compare, EveryNumberOfEveryPoseCounts) {
    for (std::size_t row = 0; row < 20; ++row) {
        for (std::size_t field = 0; field < 8; ++field) {
            RecordedRun other = sample();
            double& number = other.poses[row].numbers[field];
            const double before = number;
            number = std::nextafter(number, 100.0);
            const Comparison found = compared(sample(), other);
            ASSERT_TRUE(found.earliest);
            EXPECT_EQ(found.earliest->where, "frame " + std::to_string(row / 2));
            EXPECT_EQ(found.earliest->time, other.times[row / 2]);
            EXPECT_EQ(found.earliest->body, row % 2 == 0 ? "a" : "b");
            EXPECT_EQ(found.earliest->field, other.pose_fields[field]);
            EXPECT_EQ(*found.earliest->by, number - before);
            EXPECT_EQ(found.furthest > 0.0, field < 3);
        }
    }
}

TEST(Compare, EveryPartOfEveryEventCounts) {
    for (std::size_t index = 0; index < 3; ++index) {
        for (std::size_t field = 0; field < 12; ++field) {
            RecordedRun other = sample();
            other.events[index].numbers[field] += 0.5;
            const auto found = compared(other, sample()).earliest;
            ASSERT_TRUE(found);
            EXPECT_EQ(found->field, eventFields()[field]);
            EXPECT_EQ(found->where, "event " + std::to_string(index) + " (impact)");
            EXPECT_DOUBLE_EQ(*found->by, 0.5);
        }
    }
    RecordedRun other = sample();
    other.events[1].body = "a";
    EXPECT_EQ(compared(sample(), other).earliest->field, "body");
    other = sample();
    other.events[1].type = "release";
    EXPECT_EQ(compared(sample(), other).earliest->field, "type");
    other = sample();
    other.events[1].time = 0.41;
    EXPECT_EQ(compared(sample(), other).earliest->field, "time");
    EXPECT_EQ(compared(sample(), other).earliest->time, 0.4);
    other = sample();
    other.events[1].other = "wall";
    EXPECT_EQ(compared(sample(), other).earliest->second, "wall");
}

TEST(Compare, AMissingEventIsADifference) {
    RecordedRun shorter = sample();
    shorter.events.pop_back();
    const auto found = compared(sample(), shorter).earliest;
    ASSERT_TRUE(found);
    EXPECT_EQ(found->time, 0.65);
    EXPECT_EQ(found->first, "there");
    EXPECT_EQ(found->second, "missing");
    EXPECT_EQ(compared(shorter, sample()).earliest->first, "missing");
}

TEST(Compare, TheEarliestIsNamedAndTheFurthestMeasured) {
    RecordedRun other = sample();
    other.poses[19].numbers[0] += 3.0;
    other.poses[19].numbers[2] += 4.0;
    other.poses[8].numbers[7] = 1.25;
    other.events[2].numbers[0] = 0.0;
    Comparison found = compared(sample(), other);
    EXPECT_EQ(found.earliest->where, "frame 4");
    EXPECT_EQ(found.earliest->field, "stretch");
    EXPECT_DOUBLE_EQ(found.furthest, 5.0);
    EXPECT_EQ(found.furthest_body, "b");
    EXPECT_EQ(found.furthest_time, 0.9);
    // Of what happens at one time, the event is told.
    other.events[1].numbers[11] = 7.0;
    EXPECT_EQ(compared(sample(), other).earliest->where, "event 1 (impact)");
}

TEST(Compare, PhasesOfTablesCount) {
    RecordedRun other = sample(RecordedRun::Kind::Poses);
    other.poses[5].phase = "rest";
    const auto found = compared(sample(RecordedRun::Kind::Poses), other).earliest;
    EXPECT_EQ(found->field, "phase");
    EXPECT_EQ(found->second, "rest");
    EXPECT_FALSE(found->by);
}

TEST(Compare, UnlikeRunsAreRefused) {
    const auto refusal = [](const RecordedRun& other) {
        const auto result = compareRuns(sample(), other);
        return result.ok() ? std::string() : result.error().text();
    };
    EXPECT_NE(refusal(sample(RecordedRun::Kind::Poses)).find("kinds"), std::string::npos);
    RecordedRun other = sample();
    other.fps = 20.0;
    EXPECT_NE(refusal(other).find("fps): 10 and 20"), std::string::npos);
    other = sample();
    other.duration = 0.95;
    EXPECT_NE(refusal(other).find("durations: 0.9 and 0.95"), std::string::npos);
    other = sample();
    other.bodies[1] = "c";
    EXPECT_NE(refusal(other).find("bodies: a, b and a, c"), std::string::npos);
    other = sample();
    other.shapes[1] = "can";
    EXPECT_NE(refusal(other).find("shapes"), std::string::npos);
    other = sample();
    other.times.pop_back();
    EXPECT_NE(refusal(other).find("10 and 9 frames"), std::string::npos);
}

} // namespace
} // namespace elastoon
