// Charts: files that are what their ending says, the same bytes each time, and the numbers that they are drawn from.
#include "chart.h"

#include "chart_scale.h"
#include "curve_figure.h"
#include "export_support.h"
#include "model_plots.h"

namespace elastoon {

namespace {

Chart sample() {
    Chart chart;
    chart.title = "A & B < C";
    chart.x = {"time *t*, s", 0.0, 2.0, false, {}};
    chart.y = {"height", 0.01, 100.0, true, {}};
    ChartCurve curve;
    curve.label = "*s*_{in}";
    for (int i = 0; i <= 100; ++i) {
        curve.points.push_back({0.02 * i, 0.02 + 0.5 * i});
    }
    chart.curves = {curve};
    chart.marks.push_back({{1.0, 25.0}, "here", CaptionSide::BelowRight, Vec3(0.1), true, true});
    chart.spans.push_back({0.0, 1.0, "first", chartColor(1)});
    return chart;
}

class ChartFile : public testing::Test {
protected:
    std::string bytesOf(const std::string& name) {
        const Status written = writeChart(sample(), folder_.file(name));
        EXPECT_TRUE(written.ok()) << (written ? "" : written.error().text());
        return contentOf(folder_.file(name));
    }
    TestFolder folder_{"chart"};
};

std::size_t occurrences(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++count;
    }
    return count;
}

} // namespace

TEST_F(ChartFile, IsWhatItsEndingSays) {
    const std::string png = bytesOf("a.png");
    EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_EQ(png.substr(16, 8), std::string("\0\0\5\0\0\0\3\x20", 8)) << "1280 x 800";
    EXPECT_EQ(png.substr(png.size() - 8, 4), "IEND");
    const std::string pdf = bytesOf("a.pdf");
    EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
    EXPECT_NE(pdf.rfind("%%EOF"), std::string::npos);
    EXPECT_NE(pdf.find("CreationDate (20000101"), std::string::npos) << "the clock must not show";
    EXPECT_EQ(bytesOf("a.PNG"), png) << "large letters are endings too";
}

TEST_F(ChartFile, SvgIsSmallAndItsWordsAreText) {
    const std::string svg = bytesOf("a.svg");
    EXPECT_EQ(svg.substr(0, 5), "<?xml");
    EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
    EXPECT_LT(svg.size(), 20000U);
    EXPECT_NE(svg.find("A &amp; B &lt; C"), std::string::npos);
    EXPECT_EQ(occurrences(svg, "<text "), occurrences(svg, "</text>"));
    EXPECT_EQ(occurrences(svg, "<g ") + occurrences(svg, "<g>"), occurrences(svg, "</g>"));
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST_F(ChartFile, HasTheSameBytesEachTime) {
    EXPECT_EQ(bytesOf("a.svg"), bytesOf("b.svg"));
    EXPECT_EQ(bytesOf("a.png"), bytesOf("b.png"));
    EXPECT_EQ(bytesOf("a.pdf"), bytesOf("b.pdf"));
}

TEST_F(ChartFile, BadPlaceEndingOrAxisIsRefusedAndNothingIsLeft) {
    std::ofstream(folder_.file("plain")) << "x";
    const Status place = writeChart(sample(), folder_.file("plain/a.svg"));
    ASSERT_FALSE(place.ok());
    EXPECT_NE(place.error().text().find("plain"), std::string::npos);
    const Status ending = writeChart(sample(), folder_.file("a.bmp"));
    ASSERT_FALSE(ending.ok());
    EXPECT_NE(ending.error().text().find(".svg"), std::string::npos) << "says what would be right";
    Chart flat = sample();
    flat.x.to = flat.x.from;
    EXPECT_FALSE(writeChart(flat, folder_.file("a.svg")).ok());
    Chart below = sample();
    below.y.from = 0.0;
    EXPECT_FALSE(writeChart(below, folder_.file("a.svg")).ok()) << "a logarithmic axis from 0";
    EXPECT_EQ(folder_.count(), 1U);
}

TEST_F(ChartFile, ModelPlotsAndCurveFigureAreWritten) {
    ASSERT_TRUE(writeModelPlots(folder_.file("plots")).ok());
    for (const char* name : {"stretch", "squash", "contact_time", "apex", "turn"}) {
        const std::string svg = contentOf(folder_.file("plots/model_" + std::string(name) + ".svg"));
        EXPECT_NE(svg.find("</svg>"), std::string::npos) << name;
        EXPECT_LT(svg.size(), 40000U) << name;
    }
    EXPECT_TRUE(writeCurveFigure(folder_.file("figure4.png")).ok());
    EXPECT_FALSE(writeModelPlots(folder_.file("figure4.png")).ok());
}

TEST(CurveFigure, ShowsTheDesignsCheckFigures) {
    const CurveExample example = curveExample();
    EXPECT_NEAR(example.input.speed_in, 14.007, 5e-4);
    EXPECT_NEAR(example.curve.s_in, 1.5835, 5e-5);
    EXPECT_NEAR(example.curve.s_mid, 0.6041, 5e-5);
    EXPECT_NEAR(example.curve.t_in, 0.1098, 5e-5);
    EXPECT_NEAR(example.curve.s_out, 1.4119, 5e-5);
    EXPECT_NEAR(example.curve.t_out, 0.1812, 5e-5);
}

TEST(ChartScale, PutsTicksAtRoundNumbers) {
    const auto labels = [](const ChartAxis& axis, int wanted) {
        std::string text;
        for (const ChartTick& tick : ticksOf(axis, wanted)) {
            text += (text.empty() ? "" : " ") + tick.label;
        }
        return text;
    };
    EXPECT_EQ(labels({"", 0.0, 40.0, false, {}}, 7), "0 5 10 15 20 25 30 35 40");
    EXPECT_EQ(labels({"", -0.3, 0.3, false, {}}, 6), "\u22120.3 \u22120.2 \u22120.1 0.0 0.1 0.2 0.3");
    EXPECT_EQ(labels({"", 0.01, 100.0, true, {}}, 5), "0.01 0.1 1 10 100");
    EXPECT_EQ(labels({"", 1e-5, 1e-4, true, {}}, 5), "10^{\u22125} 10^{\u22124}");
}

TEST(ChartScale, MapsEndsAndMiddle) {
    const ChartScale linear{2.0, 4.0, 100.0, 300.0, false};
    EXPECT_DOUBLE_EQ(linear.at(2.0), 100.0);
    EXPECT_DOUBLE_EQ(linear.at(3.0), 200.0);
    const ChartScale logarithmic{0.01, 100.0, 0.0, 400.0, true};
    EXPECT_NEAR(logarithmic.at(1.0), 200.0, 1e-9);
    EXPECT_NEAR(logarithmic.at(0.1), 100.0, 1e-9);
}

TEST(ChartScale, SimplifyingKeepsTheCurve) {
    std::vector<ChartPoint> line;
    for (int i = 0; i <= 1000; ++i) {
        line.push_back({0.4 * i, 100.0 * std::sin(0.01 * i)});
    }
    const std::vector<ChartPoint> few = simplified(line, 0.05);
    EXPECT_LT(few.size(), 150U);
    ASSERT_GT(few.size(), 10U);
    std::size_t next = 1;
    for (const ChartPoint& point : line) {
        while (few[next].x < point.x) {
            ++next;
        }
        const ChartPoint& a = few[next - 1];
        const ChartPoint& b = few[next];
        const double along = (point.x - a.x) / (b.x - a.x);
        EXPECT_NEAR(a.y + along * (b.y - a.y), point.y, 0.05 * std::hypot(b.x - a.x, b.y - a.y) / (b.x - a.x) + 1e-9);
    }
}

} // namespace elastoon
