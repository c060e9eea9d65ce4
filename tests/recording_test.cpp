// The tables that other programs read: exact headers, every row, numbers that come back as they were.
#include "recording.h"

#include "export_support.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

namespace elastoon {

namespace {

constexpr double kFps = 24.0;
constexpr double kDuration = 2.5;

/// Rows of cells (RFC 4180), without regard to what stands in them.
std::vector<std::vector<std::string>> parseCsv(const std::string& text) {
    std::vector<std::vector<std::string>> rows;
    std::vector<std::string> row{""};
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
            row.back() += text[++i];
        } else if (c == '"') {
            quoted = !quoted;
        } else if (!quoted && c == ',') {
            row.emplace_back();
        } else if (!quoted && c == '\n') {
            rows.push_back(row);
            row = {""};
        } else {
            row.back() += c;
        }
    }
    EXPECT_EQ(row, std::vector<std::string>{""}) << "the last line has no end";
    return rows;
}

double number(const std::string& cell) {
    char* end = nullptr;
    const double value = std::strtod(cell.c_str(), &end);
    EXPECT_EQ(*end, '\0') << cell;
    return value;
}

std::string joined(const std::vector<std::string>& cells) {
    std::string text;
    for (const std::string& cell : cells) {
        text += (text.empty() ? "" : ",") + cell;
    }
    return text;
}

class Recording : public testing::Test {
protected:
    std::vector<std::vector<std::string>> poses() {
        const std::string file = folder_.file("poses.csv");
        EXPECT_TRUE(writePoseCsv(run_.scene, staged(), timeline(), kFps, kDuration, file).ok());
        return parseCsv(contentOf(file));
    }
    std::vector<std::vector<std::string>> events() {
        const std::string file = folder_.file("events.csv");
        EXPECT_TRUE(writeEventCsv(run_.scene, staged(), timeline(), file).ok());
        return parseCsv(contentOf(file));
    }
    const StagedScene& staged() const { return run_.performance.staged; }
    const Timeline& timeline() const { return run_.performance.timeline; }

    Played run_ = play(kExportScene, kDuration);
    TestFolder folder_{"recording"};
};

} // namespace

TEST_F(Recording, PosesAreTheTimelinesToTheLastBit) {
    const auto rows = poses();
    ASSERT_EQ(joined(rows.front()), "time,body,phase,px,py,pz,qx,qy,qz,qw,stretch,vx,vy,vz");
    const std::size_t bodies = run_.scene.bodies.size();
    ASSERT_EQ(rows.size(), 1 + bodies * 61) << "2.5 s at 24 Hz, both ends";
    std::set<std::string> phases;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const auto& row = rows[i];
        ASSERT_EQ(row.size(), 14U);
        const std::size_t body = (i - 1) % bodies;
        const std::size_t frame = (i - 1) / bodies;
        const double time = static_cast<double>(frame) / kFps;
        const Track& track = timeline().tracks()[body];
        const Pose pose = track.poseAt(time);
        const Vec3 velocity = track.velocityAt(time);
        const Quat& q = pose.orientation;
        const std::vector<double> wanted{time, 0.0, 0.0, pose.position.x, pose.position.y, pose.position.z, q.x,
                                         q.y,  q.z, q.w, pose.stretch,    velocity.x,      velocity.y,      velocity.z};
        EXPECT_EQ(number(row[0]), time);
        EXPECT_EQ(row[1], run_.scene.bodies[body].name);
        EXPECT_EQ(row[2], nameOf(track.phaseAt(time)));
        for (std::size_t column = 3; column < row.size(); ++column) {
            EXPECT_EQ(number(row[column]), wanted[column]) << "column " << column << " at " << time;
        }
        phases.insert(row[2]);
    }
    EXPECT_TRUE(phases.count("flight") == 1 && phases.count("impact") == 1) << "the scene shows too little";
}

TEST_F(Recording, EventsAreTheTimelines) {
    const auto rows = events();
    ASSERT_EQ(joined(rows.front()), "time,type,body,other,px,py,pz,nx,ny,nz,speed,s_in,s_mid,s_out,t_in,t_out");
    ASSERT_EQ(rows.size(), 1 + timeline().events().size());
    ASSERT_GT(rows.size(), 8U);
    std::set<std::string> types;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const Event& event = timeline().events()[i - 1];
        const auto& row = rows[i];
        ASSERT_EQ(row.size(), 16U);
        const auto body = std::find(staged().bodies.begin(), staged().bodies.end(), event.body);
        const auto other = std::find(staged().obstacles.begin(), staged().obstacles.end(), event.other);
        EXPECT_EQ(number(row[0]), event.time);
        EXPECT_EQ(row[1], nameOf(event.type));
        EXPECT_EQ(row[2], run_.scene.bodies[static_cast<std::size_t>(body - staged().bodies.begin())].name);
        EXPECT_EQ(row[3], run_.scene.obstacles[static_cast<std::size_t>(other - staged().obstacles.begin())].name);
        const std::vector<double> wanted{event.point.x,  event.point.y,  event.point.z, event.normal.x,
                                         event.normal.y, event.normal.z, event.speed,   event.s_in,
                                         event.s_mid,    event.s_out,    event.t_in,    event.t_out};
        for (std::size_t k = 0; k < wanted.size(); ++k) {
            EXPECT_EQ(number(row[4 + k]), wanted[k]) << "column " << 4 + k;
        }
        types.insert(row[1]);
    }
    EXPECT_TRUE(types.count("impact") == 1 && types.count("release") == 1);
}

TEST_F(Recording, NamesAreQuotedWhereTheyMustBe) {
    poses();
    const std::string text = contentOf(folder_.file("poses.csv"));
    EXPECT_NE(text.find("\n0,one,flight,"), std::string::npos);
    EXPECT_NE(text.find("\n0,\"two, \"\"b\"\"\",flight,"), std::string::npos);
}

TEST_F(Recording, JsonHoldsTheSame) {
    const std::string file = folder_.file("run.json");
    ASSERT_TRUE(writeRecordingJson(run_.scene, staged(), timeline(), kFps, kDuration, file).ok());
    const auto json = nlohmann::json::parse(contentOf(file));
    EXPECT_EQ(json.at("elastoon"), 1);
    EXPECT_EQ(json.at("kind"), "recording");
    EXPECT_EQ(json.at("scene"), "export");
    EXPECT_EQ(json.at("fps"), kFps);
    EXPECT_EQ(json.at("duration"), kDuration);
    EXPECT_EQ(json.at("gravity"), (std::vector<double>{0.0, -9.81, 0.0}));
    const auto pose_rows = poses();
    const std::size_t bodies = run_.scene.bodies.size();
    ASSERT_EQ(json.at("bodies").size(), bodies);
    for (std::size_t body = 0; body < bodies; ++body) {
        const auto& entry = json.at("bodies")[body];
        EXPECT_EQ(entry.at("name"), run_.scene.bodies[body].name);
        EXPECT_EQ(entry.at("shape"), run_.scene.shapes[run_.scene.bodies[body].shape].name);
        ASSERT_EQ(entry.at("frames").size(), 61U);
        for (std::size_t frame = 0; frame < 61; ++frame) {
            for (std::size_t k = 0; k < 8; ++k) {
                EXPECT_EQ(entry.at("frames")[frame].at(k).get<double>(),
                          number(pose_rows[1 + frame * bodies + body][3 + k]));
            }
        }
    }
    const auto event_rows = events();
    ASSERT_EQ(json.at("events").size(), event_rows.size() - 1);
    for (std::size_t i = 1; i < event_rows.size(); ++i) {
        for (std::size_t k = 0; k < event_rows[0].size(); ++k) {
            const auto& value = json.at("events")[i - 1].at(event_rows[0][k]);
            if (value.is_string()) {
                EXPECT_EQ(value, event_rows[i][k]);
            } else {
                EXPECT_EQ(value.get<double>(), number(event_rows[i][k])) << event_rows[0][k];
            }
        }
    }
}

TEST(RecordingTimes, RunFromZeroToTheDuration) {
    EXPECT_EQ(valueOf(frameTimes(60.0, 0.0)), std::vector<double>{0.0});
    EXPECT_EQ(valueOf(frameTimes(60.0, 6.0)).size(), 361U);
    EXPECT_EQ(valueOf(frameTimes(100.0, 0.29)).size(), 30U) << "0.29 * 100 is 28.999999999999996";
    EXPECT_EQ(valueOf(frameTimes(10.0, 0.39)).back(), 0.3);
    EXPECT_FALSE(frameTimes(0.0, 1.0).ok());
    EXPECT_FALSE(frameTimes(-1.0, 1.0).ok());
    EXPECT_FALSE(frameTimes(60.0, std::nan("")).ok());
    EXPECT_FALSE(frameTimes(1e9, 1e9).ok());
}

TEST(RecordingNumbers, AreShortAndComeBack) {
    EXPECT_EQ(shortestNumber(0.1), "0.1");
    EXPECT_EQ(shortestNumber(6.0), "6");
    Random random(7);
    for (int i = 0; i < 10000; ++i) {
        const double value = random.uniform(-1.0, 1.0) * std::pow(10.0, random.uniform(-12.0, 12.0));
        EXPECT_EQ(number(shortestNumber(value)), value);
    }
}

TEST_F(Recording, ABadPlaceIsRefusedAndNothingIsLeft) {
    std::ofstream(folder_.file("plain")) << "x";
    const std::string inside = folder_.file("plain/poses.csv");
    EXPECT_FALSE(writePoseCsv(run_.scene, staged(), timeline(), kFps, kDuration, inside).ok());
    EXPECT_FALSE(writeEventCsv(run_.scene, staged(), timeline(), inside).ok());
    EXPECT_FALSE(writeRecordingJson(run_.scene, staged(), timeline(), kFps, kDuration, inside).ok());
    EXPECT_EQ(folder_.count(), 1U);
}

} // namespace elastoon
