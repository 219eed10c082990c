// SPDX-License-Identifier: BSD-3-Clause
// Each rule of a shot by facts that are made up: what it finds, and what is nearly the same and no
// fault.
#include <functional>
#include <gmock/gmock.h>

#include "shots.h"

namespace tonetool::sequence {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using Change = std::function<void(QcFacts& facts, int number)>;
constexpr int kFrames = 12;
constexpr size_t kCells = size_t(QcPicture::kWide) * QcPicture::kHigh;

// The depth of a wall before which a camera has moved so far.
QcGuide guide_of(double moved, double zoom = 0) {
    QcGuide guide{"Depth.Z", 1, {}};
    for (int y = 0; y < QcPicture::kHigh; ++y)
        for (int x = 0; x < QcPicture::kWide; ++x)
            guide.cells.push_back(QcGuide::code(12 + 4 * std::sin(0.4 * x + 0.05 * moved) +
                                                2 * std::sin(0.5 * y + 0.2 * x + zoom)));
    return guide;
}

// A frame of a render: with noise, an alpha, and a depth.
QcFacts render_of(int number) {
    QcFacts facts = facts_of(number);
    QcPicture& picture = facts.picture;
    const double grain = 1 + 0.01 * (number % 3);
    picture.fine = 0.3 * grain;
    picture.coarse = 0.2 * grain;
    picture.across = 0.4 * grain;
    picture.down = 0.38 * grain;
    picture.alpha_mean = 0.5;
    facts.layers.push_back(
        {"Depth.Z", "depth", std::to_string(number), false, 200000, 6, 18, 12, {}, {}, {}});
    facts.guides = {guide_of(number)};
    return facts;
}

std::vector<std::string> found_with(const Change& change, int frames = kFrames) {
    std::vector<FrameResult> shot;
    for (int number = 1; number <= frames; ++number) {
        QcFacts facts = render_of(number);
        change(facts, number);
        shot.push_back(result_of(number, facts));
    }
    return codes_of(shot);
}

// Changes the frames from first to last alone.
Change in(int first, int last, const std::function<void(QcFacts&)>& change) {
    return [=](QcFacts& facts, int number) {
        if (number >= first && number <= last)
            change(facts);
    };
}

Change at(int number, const std::function<void(QcFacts&)>& change) {
    return in(number, number, change);
}

std::function<void(QcFacts&)> brighter(int milli_stops) {
    return [=](QcFacts& facts) {
        for (int16_t& cell : facts.picture.thumbnail)
            cell = int16_t(cell + milli_stops);
    };
}

std::function<void(QcFacts&)> tinted(int red, int blue) {
    return [=](QcFacts& facts) {
        for (size_t i = 0; i < kCells; ++i) {
            facts.picture.red[i] = int16_t(facts.picture.red[i] + red);
            facts.picture.blue[i] = int16_t(facts.picture.blue[i] + blue);
        }
    };
}

TEST(QcRules, ARenderHasNoFault) {
    EXPECT_THAT(found_with([](QcFacts&, int) {}), IsEmpty());
}

TEST(QcRules, Light) {
    EXPECT_THAT(found_with(at(6, brighter(100))), ElementsAre("6 light"));
    EXPECT_THAT(found_with(at(6, brighter(-100))), ElementsAre("6 light"));
    EXPECT_THAT(found_with(in(6, 7, brighter(100))), ElementsAre("6 light"));
    EXPECT_THAT(found_with(in(5, 10, brighter(100))), ElementsAre("5 light"));
    EXPECT_THAT(found_with(at(12, brighter(400))), ElementsAre("12 light"));
    EXPECT_THAT(found_with(at(1, brighter(400))), ElementsAre("2 light"));
    EXPECT_THAT(found_with(at(6, brighter(40))), IsEmpty());
    EXPECT_THAT(found_with(at(12, brighter(150))), IsEmpty()); // a light may go on at the end
    // It gets darker all the time.
    EXPECT_THAT(found_with([](QcFacts& facts, int number) { brighter(-300 * number)(facts); }),
                IsEmpty());
    // Candles: as much in each frame.
    EXPECT_THAT(
        found_with([](QcFacts& facts, int number) { brighter(number % 2 == 0 ? 60 : -60)(facts); }),
        IsEmpty());
}

TEST(QcRules, TintAndSaturation) {
    EXPECT_THAT(found_with(at(6, tinted(4, 0))), ElementsAre("6 tint", "6 saturation"));
    EXPECT_THAT(found_with(at(6, tinted(0, -4))), ElementsAre("6 tint", "6 saturation"));
    EXPECT_THAT(found_with(at(6, tinted(1, -1))), ElementsAre("6 saturation"));
    EXPECT_THAT(found_with(at(6, tinted(1, 0))), IsEmpty());
    EXPECT_THAT(found_with([](QcFacts& facts, int number) { tinted(4 * number, 0)(facts); }),
                IsEmpty()); // the sun sets
    // The light explains it, and the colour of what is nearly black is none.
    EXPECT_THAT(found_with(at(6,
                              [](QcFacts& facts) {
                                  brighter(100)(facts);
                                  tinted(4, 0)(facts);
                              })),
                ElementsAre("6 light"));
}

TEST(QcRules, Noise) {
    const auto noisier = [](double factor) {
        return [=](QcFacts& facts) {
            facts.picture.fine *= factor;
            facts.picture.coarse *= factor;
        };
    };
    EXPECT_THAT(found_with(at(6, noisier(1.4))), ElementsAre("6 noise"));
    EXPECT_THAT(found_with(at(6, noisier(0.7))), ElementsAre("6 noise"));
    EXPECT_THAT(found_with(in(7, 12, noisier(1.6))), ElementsAre("7 noise"));
    EXPECT_THAT(found_with(at(6, noisier(1.2))), IsEmpty());
    EXPECT_THAT(found_with(in(7, 12, noisier(1.3))), IsEmpty());
    EXPECT_THAT(found_with(at(6, noisier(0))), IsEmpty()); // a plain picture has none
}

TEST(QcRules, SharpnessAndBlur) {
    const auto sharper = [](double factor) {
        return [=](QcFacts& facts) { facts.picture.fine *= factor; };
    };
    const auto blurred = [](double factor) {
        return [=](QcFacts& facts) { facts.picture.across *= factor; };
    };
    EXPECT_THAT(found_with(at(6, sharper(1.22))), ElementsAre("6 sharpness"));
    EXPECT_THAT(found_with(at(6, sharper(0.82))), ElementsAre("6 sharpness"));
    EXPECT_THAT(found_with(at(6, sharper(1.12))), IsEmpty());
    EXPECT_THAT(found_with(at(6, blurred(0.85))), ElementsAre("6 blur"));
    EXPECT_THAT(found_with(at(6, blurred(0.92))), IsEmpty());
}

TEST(QcRules, AlphaLevel) {
    const auto alpha = [](double value) {
        return [=](QcFacts& facts) { facts.picture.alpha_mean = value; };
    };
    EXPECT_THAT(found_with(at(6, alpha(0.55))), ElementsAre("6 alphalevel"));
    EXPECT_THAT(found_with(in(7, 12, alpha(0.6))), ElementsAre("7 alphalevel"));
    EXPECT_THAT(found_with(at(6, alpha(0.51))), IsEmpty());
    EXPECT_THAT(found_with(in(7, 12, alpha(0.54))), IsEmpty());
    EXPECT_THAT(found_with([](QcFacts& facts, int number) {
                    facts.picture.alpha_mean = 0.05 * number; // somebody walks in
                }),
                IsEmpty());
    // A frame without an alpha: the channels tell.
    EXPECT_THAT(found_with(at(6, alpha(0))), IsEmpty());
}

TEST(QcRules, LayerLight) {
    const auto key = [](double factor) {
        return [=](QcFacts& facts) { facts.layers[1].mean *= factor; };
    };
    EXPECT_THAT(found_with(at(6, key(1.3))), ElementsAre("6 layerlight"));
    EXPECT_THAT(found_with(in(7, 12, key(0.7))), ElementsAre("7 layerlight"));
    EXPECT_THAT(found_with(at(6, key(1.1))), IsEmpty());
    EXPECT_THAT(found_with([](QcFacts& facts, int number) {
                    facts.layers[1].mean *= std::exp2(0.4 * number); // a lamp is dimmed up
                }),
                IsEmpty());
    // A hole explains it.
    EXPECT_THAT(found_with(at(6,
                              [&](QcFacts& facts) {
                                  key(1.3)(facts);
                                  facts.picture.rectangles = {{160, 96, 64, 64, {}, false}};
                              })),
                ElementsAre("6 hole"));
}

// The points of a rectangle of another frame.
Change with_points_of(int from, int number, size_t width, size_t height, size_t apart = 1) {
    const QcPicture other = render_of(from).picture;
    return [=](QcFacts& facts, int here) {
        for (size_t y = 0; y < height; ++y)
            for (size_t x = 0; x < width; ++x) {
                const size_t point = (10 + y) * size_t(QcPicture::kPeaksWide) + 20 + apart * x;
                facts.picture.peaks[point] = int16_t(here == number ? from : here);
                if (here == number)
                    facts.picture.fingerprints[point] = other.fingerprints[point];
            }
    };
}

TEST(QcRules, StaleBucket) {
    EXPECT_THAT(found_with(with_points_of(3, 8, 8, 6)), ElementsAre("8 stalebucket"));
    EXPECT_THAT(found_with(with_points_of(8, 3, 8, 6)), ElementsAre("3 stalebucket"));
    EXPECT_THAT(found_with(with_points_of(4, 8, 3, 2)), ElementsAre("8 stalebucket"));
    // These two frames share a point by chance, elsewhere.
    EXPECT_THAT(found_with(with_points_of(7, 8, 3, 2)), ElementsAre("8 stalebucket"));
    EXPECT_THAT(found_with(with_points_of(3, 8, 2, 2)), IsEmpty());    // one square may be chance
    EXPECT_THAT(found_with(with_points_of(3, 8, 8, 6, 2)), IsEmpty()); // no rectangle
    // A still part under a fixed seed, which all frames share, or many one after the other.
    for (const int last : {12, 9}) {
        const std::vector<uint16_t> still = render_of(1).picture.fingerprints;
        EXPECT_THAT(found_with(in(4, last,
                                  [&](QcFacts& facts) {
                                      for (size_t i = 0; i < 640; ++i)
                                          facts.picture.fingerprints[i] = still[i];
                                  })),
                    IsEmpty());
    }
    // Places of one colour have no fingerprint.
    EXPECT_THAT(found_with([](QcFacts& facts, int number) {
                    for (size_t i = 0; (number == 3 || number == 8) && i < 640; ++i)
                        facts.picture.fingerprints[i] = 0;
                }),
                IsEmpty());
}

TEST(QcRules, OddFrame) {
    EXPECT_THAT(found_with(at(6, [](QcFacts& facts) { facts.guides = {guide_of(30)}; })),
                ElementsAre("6 oddframe"));
    EXPECT_THAT(found_with(at(6,
                              [](QcFacts& facts) { // an object is missing
                                  for (size_t i = 100; i < 106; ++i)
                                      facts.guides[0].cells[i] = QcGuide::code(40);
                              })),
                ElementsAre("6 oddframe"));
    EXPECT_THAT(found_with(at(6, [](QcFacts& facts) { facts.guides[0].cells[100] += 900; })),
                IsEmpty()); // a cell alone
    // A camera that sways, one that shakes, one that starts and stops.
    const auto moves = [](const std::function<double(int)>& way) {
        return [=](QcFacts& facts, int number) { facts.guides = {guide_of(way(number))}; };
    };
    EXPECT_THAT(found_with(moves([](int n) { return 6 + 5 * std::cos(n * 0.5); })), IsEmpty());
    EXPECT_THAT(found_with(moves([](int n) { return n + 2 * std::sin(n * 2.1); })), IsEmpty());
    EXPECT_THAT(found_with(moves([](int n) { return 0.3 * n * n; })), IsEmpty());
}

TEST(QcRules, Order) {
    EXPECT_THAT(found_with([](QcFacts& facts, int number) {
                    if (number == 6 || number == 7)
                        facts = render_of(13 - number);
                }),
                ElementsAre("6 order"));
    // Back and forth by intent, all the time.
    EXPECT_THAT(found_with([](QcFacts& facts, int number) {
                    facts.guides = {guide_of(number % 2 == 0 ? number - 1.5 : number + 1.5)};
                }),
                IsEmpty());
}

TEST(QcRules, Skip) {
    const auto jump = [](double by) {
        return [=](QcFacts& facts, int number) {
            facts.guides = {guide_of(number < 7 ? number : number + by)};
        };
    };
    EXPECT_THAT(found_with(jump(1)), ElementsAre("7 skip"));
    EXPECT_THAT(found_with(jump(0.3)), IsEmpty());
    EXPECT_THAT(found_with(jump(12)), IsEmpty()); // a cut
    EXPECT_THAT(found_with([](QcFacts& facts, int number) {
                    facts.guides = {guide_of(0.2 * number * number)}; // faster and faster
                }),
                IsEmpty());
}

TEST(QcRules, Pop) {
    // A fixed camera, and cells that are others in some frames.
    const auto with = [](int first, int last, size_t count) {
        return [=](QcFacts& facts, int number) {
            facts.guides = {guide_of(0)};
            for (size_t i = 0; number >= first && number <= last && i < count; ++i)
                facts.guides[0].cells[200 + i] = QcGuide::code(30);
        };
    };
    EXPECT_THAT(found_with(with(7, 12, 5)), ElementsAre("7 pop"));
    EXPECT_THAT(found_with(with(1, 12, 5)), IsEmpty());
    EXPECT_THAT(found_with(with(7, 12, 1)), IsEmpty());
    EXPECT_THAT(found_with(with(7, 12, 320)), IsEmpty()); // a cut to another place
    // Something moves on, and there it goes.
    EXPECT_THAT(found_with([](QcFacts& facts, int number) {
                    facts.guides = {guide_of(0)};
                    for (size_t i = 0; i < 4; ++i)
                        facts.guides[0].cells[200 + size_t(number) + i] = QcGuide::code(30);
                }),
                IsEmpty());
}

TEST(QcRules, CutAtEnd) {
    const auto other = [](QcFacts& facts) { facts.guides = {guide_of(40, 2)}; };
    EXPECT_THAT(found_with(at(12, other)), ElementsAre("12 cutatend"));
    EXPECT_THAT(found_with(at(1, other)), ElementsAre("1 cutatend"));
    EXPECT_THAT(found_with(in(7, 12, other)), IsEmpty());
    EXPECT_THAT(found_with(at(12, [](QcFacts& facts) { facts.guides = {guide_of(13)}; })),
                IsEmpty());
    // On threes, where the last frame begins the next three; a fixed camera, and another one.
    EXPECT_THAT(found_with([](QcFacts& facts, int number) { facts = render_of(number / 3 * 3); }),
                IsEmpty());
    EXPECT_THAT(found_with([&](QcFacts& facts, int number) {
                    facts.guides = {guide_of(0)};
                    facts.layers[2].hash = number < 12 ? "here" : "there";
                    if (number == 12)
                        other(facts);
                }),
                ElementsAre("12 cutatend"));
}

TEST(QcRules, HotPixel) {
    const auto spike = [](QcFacts& facts) {
        facts.picture.spikes = {{300, 200, 100, 0.5}};
        facts.picture.peaks[20 * size_t(QcPicture::kPeaksWide) + 30] = 53; // 2^(53/8) is 99
    };
    EXPECT_THAT(found_with(in(1, 12, spike)), ElementsAre("1 hotpixel"));
    EXPECT_THAT(found_with(in(4, 11, spike)), ElementsAre("1 hotpixel"));
    EXPECT_THAT(found_with(in(6, 11, spike)), IsEmpty()); // in half of the frames
    // A lamp before a fixed camera, and one that moves.
    EXPECT_THAT(found_with([&](QcFacts& facts, int) {
                    spike(facts);
                    facts.layers[2].hash = "still";
                }),
                IsEmpty());
    EXPECT_THAT(found_with([&](QcFacts& facts, int number) {
                    spike(facts);
                    facts.picture.spikes[0].x += number % 5;
                }),
                IsEmpty());
}

TEST(QcRules, Clip) {
    const auto clipped = [](int64_t one, int64_t beside, int64_t largest) {
        return [=](QcFacts& facts) {
            facts.picture.at_one = one;
            facts.picture.beside_one = beside;
            facts.picture.at_largest_half = largest;
        };
    };
    EXPECT_THAT(found_with(in(3, 5, clipped(1000, 0, 0))), ElementsAre("3 clip"));
    EXPECT_THAT(found_with(in(1, 12, clipped(1000, 200, 0))), ElementsAre("1 clip"));
    EXPECT_THAT(found_with(in(3, 5, clipped(1000, 300, 0))), IsEmpty()); // by chance
    EXPECT_THAT(found_with(in(3, 5, clipped(100, 0, 0))), IsEmpty());    // 0.04 %
    EXPECT_THAT(found_with(at(3, clipped(0, 0, 10))), ElementsAre("3 clip"));
    EXPECT_THAT(found_with(at(3, clipped(0, 0, 9))), IsEmpty());
}

TEST(QcRules, Magenta) {
    const auto share = [](double value) {
        return [=](QcFacts& facts) { facts.picture.magenta = value; };
    };
    EXPECT_THAT(found_with(in(4, 6, share(0.001))), ElementsAre("4 magenta"));
    EXPECT_THAT(found_with(in(4, 6, share(0.0004))), IsEmpty());
}

TEST(QcRules, FewFrames) {
    const auto nothing = [](QcFacts&, int) {};
    EXPECT_THAT(found_with(nothing, 1), IsEmpty());
    EXPECT_THAT(found_with(nothing, 4), ElementsAre("1 fewframes"));
    EXPECT_THAT(found_with(nothing, 5), IsEmpty());
    // Rules that need more are silent.
    EXPECT_THAT(found_with(at(2, tinted(9, 0)), 4), ElementsAre("1 fewframes"));
}

// Frames between which others lack are no neighbours.
TEST(QcRules, NothingIsJudgedAcrossAGap) {
    std::vector<FrameResult> shot;
    for (const int number : {1, 2, 3, 4, 5, 6, 12, 13, 14, 15, 16, 17})
        shot.push_back(result_of(number, render_of(number)));
    EXPECT_THAT(codes_of(shot), ElementsAre("12 missing"));
}

} // namespace
} // namespace tonetool::sequence
