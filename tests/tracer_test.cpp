// Pictures: the same bits on any number of threads, shadows where they belong, shortcuts that do not show.
#include "picture.h"
#include "sampling.h"
#include "tracer.h"

#include "test_support.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace elastoon {
namespace {

/// A ball over a floor, seen from in front; y is the height of its centre.
struct Studio {
    explicit Studio(PictureSize size, int threads = 0, int samples = 16, bool with_walls = false)
        : tracer(valueOf(Tracer::create(size, {samples, threads}))) {
        ball = tracer.addMesh(drawnMesh(*valueOf(Shape::sphere(0.5)), true));
        box = tracer.addMesh(drawnMesh(*valueOf(Shape::box({0.8, 0.6, 0.8})), false));
        Setting setting;
        setting.radius = 2.0F;
        setting.to_light = glm::normalize(setting.to_light);
        setting.ground = DrawnPlane{};
        std::vector<Thing> solids;
        if (with_walls) {
            setting.walls.push_back({{0.0F, 0.0F, -1.5F}, {0.0F, 0.0F, 1.0F}, Color(1.0F)});
            solids.push_back({box, {{1.2, 0.3, -0.4}, kNoRotation, 1.0}, thingColors({0.4, 0.6, 0.7})});
        }
        const double aspect = static_cast<double>(size.width) / size.height;
        tracer.place(setting, cameraFrom({{0.0, 1.6, 7.0}, {0.0, 0.8, 0.0}, 30.0}, {0.0, 1.0, 0.0}, aspect), solids);
    }
    [[nodiscard]] Thing ballAt(const Vec3& position, double stretch = 1.0) const {
        const Quat upright = glm::angleAxis(1.5707963267948966, Vec3(0.0, 0.0, 1.0));
        return {ball, {position, upright, stretch}, thingColors({0.894, 0.341, 0.180})};
    }

    Tracer tracer;
    std::size_t ball = 0, box = 0;
};

double meanDifference(const Picture& a, const Picture& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        sum += glm::length(a.pixels[i] - b.pixels[i]);
    }
    return sum / static_cast<double>(a.pixels.size());
}

TEST(Sampling, EveryQuarterOfAPowerOfTwoIsStratified) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        std::array<int, 16> cells{};
        for (std::uint32_t i = 0; i < 16; ++i) {
            const glm::vec2 p = sampling::point(seed, i);
            ASSERT_TRUE(p.x >= 0.0F && p.x < 1.0F && p.y >= 0.0F && p.y < 1.0F);
            ++cells[static_cast<std::size_t>(p.y * 4.0F) * 4 + static_cast<std::size_t>(p.x * 4.0F)];
        }
        for (const int count : cells) {
            EXPECT_EQ(count, 1);
        }
    }
}

TEST(Sampling, DirectionsAreUnitAndOnTheRightSide) {
    Random random(3);
    for (std::uint32_t i = 0; i < 500; ++i) {
        const glm::vec3 normal(random.direction());
        const glm::vec2 disk = sampling::diskPoint(sampling::point(9, i));
        const glm::vec3 direction = sampling::cosineDirection(normal, sampling::point(9, i));
        EXPECT_LE(glm::dot(disk, disk), 1.00001F);
        EXPECT_NEAR(glm::length(direction), 1.0F, 1e-5F);
        EXPECT_GE(glm::dot(direction, normal), -1e-5F);
    }
}

TEST(Tracer, TheThreadCountDoesNotShow) {
    const PictureSize size{120, 68};
    std::vector<Picture> pictures;
    for (const int threads : {1, 2, 5}) {
        const Studio studio(size, threads, 16, true);
        const std::array things{studio.ballAt({-0.3, 0.55, 0.2}, 0.8), studio.ballAt({0.6, 1.4, 0.0}, 1.5)};
        pictures.push_back(studio.tracer.picture(things));
    }
    EXPECT_EQ(pictures[0].pixels, pictures[1].pixels);
    EXPECT_EQ(pictures[0].pixels, pictures[2].pixels);
}

TEST(Tracer, TheBallIsThereWithItsShadowAndElsewhereIsTheBackground) {
    const Studio studio({160, 90});
    const std::array things{studio.ballAt({0.0, 0.5, 0.0})};
    const Layer layer = studio.tracer.layer(things);
    const Picture picture = studio.tracer.picture(things);
    const Picture& background = studio.tracer.background();
    double covered = 0.0;
    for (const LayerPixel& pixel : layer.pixels) {
        covered += pixel.coverage;
        ASSERT_TRUE(pixel.coverage >= 0.0F && pixel.coverage <= 1.0F);
    }
    // A circle: its radius from the camera, in pixels.
    const double radius = 0.5 / std::hypot(7.0, 1.1) / std::tan(15.0 * 3.14159265 / 180.0) * 45.0;
    EXPECT_NEAR(covered, 3.14159265 * radius * radius, 0.03 * 3.14159265 * radius * radius);
    // Left of the ball and far from it, nothing; right below it, shadow.
    EXPECT_EQ(picture.at(3, 45), background.at(3, 45));
    EXPECT_EQ(picture.at(80, 3), background.at(80, 3));
    float darkest = 1.0F;
    for (int x = 80; x < 120; ++x) {
        for (int y = 45; y < 89; ++y) {
            const bool beside = x >= layer.left && x < layer.left + layer.width && y >= layer.top &&
                                y < layer.top + layer.height && layer.at(x, y).coverage == 0.0F;
            darkest = beside ? std::min(darkest, picture.at(x, y).g / background.at(x, y).g) : darkest;
        }
    }
    EXPECT_LT(darkest, 0.6F);
    EXPECT_GT(darkest, 0.01F); // under the very contact
}

TEST(Tracer, FewSamplesTellTheSameAsMany) {
    const Studio studio({128, 72}, 0, 16, true);
    const std::array things{studio.ballAt({-0.4, 0.5, 0.0}, 0.9), studio.ballAt({0.7, 1.3, 0.1}, 1.4)};
    const Picture few = studio.tracer.picture(things), many = studio.tracer.picture(things, {.samples = 256});
    EXPECT_LT(meanDifference(few, many), 0.006);
    EXPECT_GT(meanDifference(few, studio.tracer.background()), 0.02);
    const Picture other_noise = studio.tracer.picture(things, {.seed = 77});
    EXPECT_NE(few.pixels, other_noise.pixels);
    EXPECT_LT(meanDifference(other_noise, many), 0.006);
}

TEST(Tracer, WithoutShadowsTheRestIsTheBackground) {
    const Studio studio({128, 72});
    const std::array things{studio.ballAt({0.0, 0.5, 0.0})};
    const Layer layer = studio.tracer.layer(things, {.shadows = false});
    for (int y = layer.top; y < layer.top + layer.height; ++y) {
        for (int x = layer.left; x < layer.left + layer.width; ++x) {
            const LayerPixel& pixel = layer.at(x, y);
            const Color expected = studio.tracer.background().at(x, y) * (1.0F - pixel.coverage);
            ASSERT_LT(glm::length(pixel.around - expected), 1e-6F);
        }
    }
}

TEST(Tracer, NothingInFrontIsTheBackground) {
    const Studio studio({64, 36});
    EXPECT_TRUE(studio.tracer.layer({}).pixels.empty());
    const std::array behind{studio.ballAt({0.0, 1.0, 30.0})}; // behind the camera
    EXPECT_EQ(studio.tracer.picture(behind).pixels, studio.tracer.background().pixels);
}

std::vector<std::uint8_t> readPpm(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    std::string magic;
    int width = 0, height = 0, most = 0;
    stream >> magic >> width >> height >> most;
    stream.get();
    return {std::istreambuf_iterator<char>(stream), {}};
}

// Golden: written by ELASTOON_WRITE_GOLDEN=1. Equal to the bit on x86-64; the tolerance is for other processors'
// builds of Embree.
TEST(Tracer, LooksLikeTheGoldenPicture) {
    const PictureSize size{96, 54};
    const Studio studio(size, 0, 32, true);
    const std::array things{studio.ballAt({-0.5, 0.42, 0.2}, 0.75), studio.ballAt({0.5, 1.5, 0.0}, 1.6)};
    const std::vector<std::uint8_t> bytes = toRgb8(studio.tracer.picture(things));
    const std::string path = std::string(ELASTOON_SOURCE_DIR) + "/tests/golden/tracer.ppm";
    if (std::getenv("ELASTOON_WRITE_GOLDEN") != nullptr) {
        std::ofstream stream(path, std::ios::binary);
        stream << "P6\n" << size.width << ' ' << size.height << "\n255\n";
        stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }
    const std::vector<std::uint8_t> golden = readPpm(path);
    ASSERT_EQ(golden.size(), bytes.size()) << path;
    double sum = 0.0;
    int far_off = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const int difference = std::abs(int{bytes[i]} - int{golden[i]});
        sum += difference;
        far_off += difference > 12 ? 1 : 0;
    }
    EXPECT_LT(sum / static_cast<double>(bytes.size()), 0.25);
    EXPECT_LT(far_off, static_cast<int>(bytes.size() / 200));
}

} // namespace
} // namespace elastoon
