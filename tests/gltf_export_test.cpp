// The .glb file, read back by another reader (assimp) and compared with the library's poses.
#include "gltf_export.h"

#include "export_support.h"

#include <assimp/Importer.hpp>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <set>

namespace elastoon {

namespace {

constexpr double kFps = 30.0;
constexpr double kDuration = 3.0;
constexpr double kSameTime = 1e-6; // s: single precision, and the reader's milliseconds

Vec3 vec(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

/// Every time at which a body must have a key: worked out here on its own.
std::vector<double> wantedTimes(const Track& track) {
    std::vector<double> times;
    for (int k = 0; k <= static_cast<int>(kDuration * kFps + 1e-9); ++k) {
        times.push_back(k / kFps);
    }
    for (const Phase& phase : track.phases()) {
        times.push_back(phase.start);
        if (const auto* impact = phase.as<Impact>()) {
            times.push_back(impact->begun + impact->curve.t_in);
        }
    }
    std::erase_if(times, [](double time) { return time > kDuration; });
    std::sort(times.begin(), times.end());
    return times;
}

double nearestOf(const std::vector<double>& times, double time) {
    return *std::min_element(times.begin(), times.end(),
                             [time](double a, double b) { return std::fabs(a - time) < std::fabs(b - time); });
}

class GltfExport : public testing::Test {
protected:
    const aiScene* exported(const Played& run) {
        const std::string file = folder_.file("scene.glb");
        const Status written = writeGlb(run.scene, run.performance.staged, run.performance.timeline, kFps, file);
        EXPECT_TRUE(written.ok()) << (written ? "" : written.error().text());
        EXPECT_EQ(folder_.count(), 1U) << "something else was left behind";
        const aiScene* scene = importer_.ReadFile(file, 0);
        EXPECT_NE(scene, nullptr) << importer_.GetErrorString();
        return scene;
    }

    static const aiNodeAnim* channelOf(const aiScene& scene, const std::string& name) {
        for (unsigned i = 0; i < scene.mAnimations[0]->mNumChannels; ++i) {
            const aiNodeAnim* channel = scene.mAnimations[0]->mChannels[i];
            if (name == channel->mNodeName.C_Str()) {
                return channel;
            }
        }
        return nullptr;
    }

    /// Corners of the meshes of a node, in the world at the start.
    static std::vector<Vec3> cornersOf(const aiScene& scene, const std::string& name) {
        std::vector<Vec3> corners;
        const aiNode* node = scene.mRootNode->FindNode(name.c_str());
        for (unsigned m = 0; node != nullptr && m < node->mNumMeshes; ++m) {
            const aiMesh& mesh = *scene.mMeshes[node->mMeshes[m]];
            for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
                corners.push_back(vec(node->mTransformation * mesh.mVertices[v]));
            }
        }
        return corners;
    }

    TestFolder folder_{"gltf"};
    Assimp::Importer importer_;
};

/// T R S of a channel's key, its last column the position.
struct KeyMatrix {
    Mat3 linear{1.0};
    Vec3 position{0.0};
};

KeyMatrix matrixAt(const aiNodeAnim& channel, unsigned key) {
    const aiQuaternion& q = channel.mRotationKeys[key].mValue;
    // A node that never scales has one scale key, or the reader adds one.
    const Vec3 scale = vec(channel.mScalingKeys[std::min(key, channel.mNumScalingKeys - 1)].mValue);
    const Mat3 rotation = glm::mat3_cast(Quat(q.w, q.x, q.y, q.z));
    return {{rotation[0] * scale.x, rotation[1] * scale.y, rotation[2] * scale.z},
            vec(channel.mPositionKeys[key].mValue)};
}

double difference(const KeyMatrix& found, const Pose& wanted) {
    const Mat3 linear = linearOf(wanted);
    double worst = glm::length(found.position - wanted.position);
    for (int i = 0; i < 3; ++i) {
        worst = std::max(worst, glm::length(found.linear[i] - linear[i]));
    }
    return worst;
}

} // namespace

TEST_F(GltfExport, EveryKeyIsTheLibrarysPose) {
    const Played run = play(kExportScene, kDuration);
    const aiScene* scene = exported(run);
    ASSERT_NE(scene, nullptr);
    ASSERT_EQ(scene->mNumAnimations, 1U);
    const double per_second = scene->mAnimations[0]->mTicksPerSecond;
    std::size_t impacts = 0;
    for (std::size_t i = 0; i < run.scene.bodies.size(); ++i) {
        const std::string& name = run.scene.bodies[i].name;
        const aiNodeAnim* channel = channelOf(*scene, name);
        ASSERT_NE(channel, nullptr) << name;
        const Track& track = run.performance.timeline.tracks()[i];
        ASSERT_EQ(track.body(), run.performance.staged.bodies[i]);
        const std::vector<double> wanted = wantedTimes(track);
        impacts += wanted.size() - static_cast<std::size_t>(kDuration * kFps) - 1;
        std::vector<double> found;
        for (unsigned k = 0; k < channel->mNumPositionKeys; ++k) {
            const double time = channel->mPositionKeys[k].mTime / per_second;
            const double exact = nearestOf(wanted, time);
            EXPECT_NEAR(time, exact, kSameTime) << name;
            EXPECT_LT(difference(matrixAt(*channel, k), track.poseAt(exact)), 1e-5) << name << " at " << exact;
            found.push_back(time);
        }
        for (const double time : wanted) {
            EXPECT_NEAR(nearestOf(found, time), time, kSameTime) << name << " lacks a key";
        }
    }
    EXPECT_GT(impacts, 10U) << "the scene shows too little";
}

TEST_F(GltfExport, TimesRiseAndTurnsGoTheShortWay) {
    // 200 degrees from frame to frame: as they come, the fan's quaternions would go the long way round.
    std::string text = kExportScene;
    const std::string slow = "[0, 40, 0]";
    ASSERT_NE(text.find(slow), std::string::npos);
    text.replace(text.find(slow), slow.size(), "[0, 6000, 0]");
    const Played run = play(text, kDuration);
    const aiScene* scene = exported(run);
    ASSERT_NE(scene, nullptr);
    for (unsigned c = 0; c < scene->mAnimations[0]->mNumChannels; ++c) {
        const aiNodeAnim& channel = *scene->mAnimations[0]->mChannels[c];
        for (unsigned k = 1; k < channel.mNumRotationKeys; ++k) {
            EXPECT_GT(channel.mRotationKeys[k].mTime, channel.mRotationKeys[k - 1].mTime);
            const aiQuaternion& a = channel.mRotationKeys[k - 1].mValue;
            const aiQuaternion& b = channel.mRotationKeys[k].mValue;
            EXPECT_GE(a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w, 0.0F) << channel.mNodeName.C_Str();
            EXPECT_NEAR(b.x * b.x + b.y * b.y + b.z * b.z + b.w * b.w, 1.0F, 1e-6F);
        }
    }
}

TEST_F(GltfExport, AMovingObstacleIsAnimatedAndAStillOneIsNot) {
    const Played run = play(kExportScene, kDuration);
    const aiScene* scene = exported(run);
    ASSERT_NE(scene, nullptr);
    EXPECT_EQ(channelOf(*scene, "floor"), nullptr);
    const aiNodeAnim* fan = channelOf(*scene, "fan");
    ASSERT_NE(fan, nullptr);
    ASSERT_EQ(fan->mNumRotationKeys, static_cast<unsigned>(kDuration * kFps) + 1);
    const unsigned last = fan->mNumRotationKeys - 1;
    EXPECT_NEAR(fan->mPositionKeys[last].mValue.y, 6.0 + 0.2 * kDuration, 1e-5);
    const Vec3 side = matrixAt(*fan, last).linear[0];
    const double angle = 40.0 * kDuration * 3.14159265358979 / 180.0;
    EXPECT_LT(glm::length(side - Vec3(std::cos(angle), 0.0, -std::sin(angle))), 1e-5);
}

TEST_F(GltfExport, PlanesReachBeyondTheActionAndEndAtEachOther) {
    const Played run = play(kExportScene, kDuration);
    const aiScene* scene = exported(run);
    ASSERT_NE(scene, nullptr);
    const std::vector<Vec3> floor = cornersOf(*scene, "floor");
    ASSERT_GE(floor.size(), 4U);
    Vec3 low = floor.front();
    Vec3 high = floor.front();
    for (const Vec3& corner : floor) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
        EXPECT_NEAR(corner.y, 0.0, 1e-6);
    }
    EXPECT_NEAR(high.x, 5.0, 1e-5) << "ends at the wall";
    for (const Track& track : run.performance.timeline.tracks()) {
        for (double t = 0.0; t <= kDuration; t += 0.05) {
            const Vec3 p = track.poseAt(t).position;
            EXPECT_TRUE(p.x > low.x && p.z > low.z && p.z < high.z) << t;
        }
    }
    for (const Vec3& corner : cornersOf(*scene, "wall")) {
        EXPECT_NEAR(corner.x, 5.0, 1e-5);
        EXPECT_GT(corner.y, -1e-5) << "ends at the floor";
    }
}

TEST_F(GltfExport, MeshesAreSharedAndHaveTheShapesSize) {
    const Played run = play(kExportScene, 0.1);
    const aiScene* scene = exported(run);
    ASSERT_NE(scene, nullptr);
    const aiNode* one = scene->mRootNode->FindNode("one");
    const aiNode* two = scene->mRootNode->FindNode("two, \"b\"");
    ASSERT_TRUE(one != nullptr && two != nullptr);
    ASSERT_EQ(one->mNumMeshes, two->mNumMeshes);
    EXPECT_GE(one->mNumMeshes, 2U) << "one part for each tint";
    Vec3 low(1e9);
    Vec3 high(-1e9);
    for (unsigned m = 0; m < one->mNumMeshes; ++m) {
        EXPECT_EQ(one->mMeshes[m], two->mMeshes[m]);
        const aiMesh& mesh = *scene->mMeshes[one->mMeshes[m]];
        // Only what the part's triangles use: its vertices may be shared with the other parts.
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            for (unsigned k = 0; k < 3; ++k) {
                low = glm::min(low, vec(mesh.mVertices[mesh.mFaces[f].mIndices[k]]));
                high = glm::max(high, vec(mesh.mVertices[mesh.mFaces[f].mIndices[k]]));
            }
        }
    }
    EXPECT_LT(glm::length(high - Vec3(0.5)), 2e-3);
    EXPECT_LT(glm::length(low + Vec3(0.5)), 2e-3);
}

TEST_F(GltfExport, ColorsAreLinear) {
    const Played run = play(kExportScene, 0.1);
    const aiScene* scene = exported(run);
    ASSERT_NE(scene, nullptr);
    bool seen = false;
    for (unsigned i = 0; i < scene->mNumMaterials; ++i) {
        aiString name;
        aiColor4D color;
        scene->mMaterials[i]->Get(AI_MATKEY_NAME, name);
        if (std::string(name.C_Str()) == "#808080 main") {
            seen = true;
            ASSERT_EQ(scene->mMaterials[i]->Get(AI_MATKEY_BASE_COLOR, color), aiReturn_SUCCESS);
            EXPECT_NEAR(color.r, 0.2158605, 1e-5); // IEC 61966-2-1 of 128/255
        }
    }
    EXPECT_TRUE(seen);
}

TEST_F(GltfExport, NothingToShowIsStillAFile) {
    const Played still = play(kExportScene, 0.0);
    const aiScene* scene = exported(still);
    ASSERT_NE(scene, nullptr);
    ASSERT_EQ(scene->mNumAnimations, 1U);
    EXPECT_EQ(channelOf(*scene, "one")->mNumPositionKeys, 1U);

    // assimp refuses a file without meshes, so here only the container is looked at; the Khronos validator does the
    // rest.
    const Played empty =
        play(R"({"elastoon": 1, "name": "e", "shapes": {}, "styles": {}, "bodies": [], "obstacles": []})", 1.0);
    const std::string file = folder_.file("empty.glb");
    EXPECT_TRUE(writeGlb(empty.scene, empty.performance.staged, empty.performance.timeline, kFps, file).ok());
    EXPECT_EQ(contentOf(file).substr(0, 4), "glTF");
}

TEST_F(GltfExport, BadRateAndBadPlaceAreRefused) {
    const Played run = play(kExportScene, 0.1);
    const auto& [staged, timeline] = run.performance;
    const Status rate = writeGlb(run.scene, staged, timeline, 0.0, folder_.file("a.glb"));
    ASSERT_FALSE(rate.ok());
    EXPECT_EQ(rate.error().where, "fps");
    std::ofstream(folder_.file("plain")) << "x";
    EXPECT_FALSE(writeGlb(run.scene, staged, timeline, kFps, folder_.file("plain/a.glb")).ok());
    EXPECT_EQ(folder_.count(), 1U);
}

} // namespace elastoon
