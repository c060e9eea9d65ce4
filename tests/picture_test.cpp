// Linear light to bytes and to files.
#include "picture.h"

#include "test_support.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numeric>

namespace elastoon {
namespace {

TEST(Picture, BytesAreTheSrgbValuesOfTheLightOnAverage) {
    for (const int byte : {0, 1, 10, 64, 128, 200, 230}) {
        for (const double between : {0.0, 0.25, 0.7}) {
            const double srgb = (byte + between) / 255.0;
            const Picture flat = makePicture({16, 16}, linearFromSrgb(Vec3(srgb)));
            const std::vector<std::uint8_t> bytes = toRgb8(flat);
            ASSERT_EQ(bytes.size(), 768U);
            const double mean = std::accumulate(bytes.begin(), bytes.end(), 0.0) / 768.0;
            if (srgb < 0.9) { // below the roll-off
                EXPECT_NEAR(mean, srgb * 255.0, 0.05) << srgb;
            }
        }
    }
}

TEST(Picture, BrightnessIsKeptInOrderAndNeverLeavesTheBytes) {
    int last = 0;
    for (float light = -0.5F; light < 8.0F; light += 0.01F) {
        const std::vector<std::uint8_t> bytes = toRgb8(makePicture({4, 4}, Color(light)));
        const int sum = std::accumulate(bytes.begin(), bytes.end(), 0);
        EXPECT_GE(sum, last);
        last = sum;
    }
    EXPECT_EQ(last, 48 * 255);
}

TEST(Picture, PngIsWrittenWholeOrNotAtAll) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "elastoon_picture";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder / "taken.png");
    EXPECT_TRUE(writePng((folder / "a.png").string(), makePicture({5, 3}, Color(0.5F))).ok());
    std::ifstream stream(folder / "a.png", std::ios::binary);
    std::string head(8, '\0');
    stream.read(head.data(), 8);
    EXPECT_EQ(head.substr(1, 3), "PNG");
    EXPECT_FALSE(writePng((folder / "taken.png").string(), makePicture({5, 3})).ok());
    EXPECT_FALSE(writePng((folder / "b.png").string(), makePicture({0, 0})).ok());
    const auto entries = std::distance(std::filesystem::directory_iterator(folder), {});
    EXPECT_EQ(entries, 2); // the picture and the folder, no temporary file
    std::filesystem::remove_all(folder);
}

} // namespace
} // namespace elastoon
