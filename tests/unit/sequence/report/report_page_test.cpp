// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/report_page.h"

#include <OpenImageIO/filesystem.h>
#include <filesystem>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "sequence/report/report_sheet.h"

namespace tonetool::sequence {
namespace {

namespace fs = OIIO::Filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

FrameResult frame(int number, double value) {
    FrameResult result;
    result.frame = number;
    result.status = Status::Passed;
    Measurement one;
    one.command = "hdrflip";
    one.thresholds = {Threshold{"p99", value, false, 0.5, {}}};
    one.quantities = {{"p99", value}};
    one.histogram.assign(100, 7);
    result.measurements = {one};
    judge(result);
    return result;
}

// `size` is about that of a frame in the page.
FramePictures pictures(size_t size, size_t thumbnail = 4) {
    FramePictures made;
    made.pictures = {"data:image/jpeg;base64,AAAA", std::string(size, 'A')};
    made.small_test = "data:image/jpeg;base64," + std::string(thumbnail, 'A');
    return made;
}

PictureCounts counts(size_t full) {
    PictureCounts counts;
    counts.full = full;
    return counts;
}

std::string full(const PictureStore& store, const FrameResult& frame) {
    return store.text(PictureSize::Full, frame);
}

std::string small(const PictureStore& store, const FrameResult& frame) {
    return store.text(PictureSize::Small, frame);
}

ShotResult shot(std::vector<FrameResult> frames) {
    ShotResult result;
    result.frames = std::move(frames);
    conclude(result);
    return result;
}

nlohmann::json data_of(const std::string& page) {
    const std::string open = "<script type=\"application/json\" id=\"result\">";
    const size_t begin = page.find(open) + open.size();
    return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

size_t count(const std::string& text, const std::string& word) {
    size_t found = 0;
    for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
        ++found;
    return found;
}

TEST(Store, KeepsTheWorstWhateverTheOrder) {
    for (const bool forward : {true, false}) {
        PictureStore store("", counts(2));
        for (int i = 0; i < 5; ++i) {
            const int number = forward ? i : 4 - i;
            store.add(frame(number, 0.1 * number), pictures(10));
        }
        for (int number = 0; number < 5; ++number) {
            EXPECT_EQ(full(store, frame(number, 0.1 * number)).empty(), number < 3) << number;
            EXPECT_FALSE(small(store, frame(number, 0.1 * number)).empty());
        }
        EXPECT_FALSE(store.wants(PictureSize::Full, frame(9, 0.2)));
        EXPECT_TRUE(store.wants(PictureSize::Full, frame(9, 0.35)));
    }
}

class Folder : public testing::Test {
protected:
    Folder() { fs::create_directory(name); }
    ~Folder() override { fs::remove_all(name); }
    std::vector<std::string> files() const {
        std::vector<std::string> found;
        fs::get_directory_entries(name, found, true);
        return found;
    }
    std::string name = testing::TempDir() + fs::unique_path("pictures-%%%%%%%%");
};

TEST_F(Folder, AContinuedRunFindsItsPictures) {
    {
        PictureStore store(name + "/p", counts(1));
        store.add(frame(1, 0.9), pictures(10));
        store.add(frame(2, 0.1), pictures(10));
    }
    PictureStore store(name + "/p", counts(1));
    EXPECT_TRUE(store.restore(frame(1, 0.9)));
    EXPECT_TRUE(store.restore(frame(2, 0.1)));
    EXPECT_FALSE(store.restore(frame(3, 0.1)));
    EXPECT_FALSE(full(store, frame(1, 0.9)).empty());
    EXPECT_TRUE(full(store, frame(2, 0.1)).empty());
    store.add(frame(4, 0.95), pictures(10));
    EXPECT_TRUE(full(store, frame(1, 0.9)).empty());
    EXPECT_FALSE(small(store, frame(1, 0.9)).empty());
}

TEST_F(Folder, PicturesOfWhatHasChangedSinceAreNotShown) {
    PictureStore store(name);
    store.add(frame(1, 0.9), pictures(10));
    FrameResult missing;
    missing.frame = 1;
    missing.status = Status::Missing;
    for (const FrameResult& other : {frame(1, 0.8), missing}) {
        EXPECT_TRUE(full(store, other).empty());
        EXPECT_TRUE(small(store, other).empty());
        EXPECT_FALSE(store.restore(other));
    }
    FrameResult faulty = frame(1, 0.9);
    faulty.faults = {{"flicker", Severity::Error, "It flickers.", "", {}, {}, {}}};
    EXPECT_FALSE(full(store, faulty).empty()); // drawn before the shot was judged
    store.forget(missing);
    EXPECT_TRUE(files().empty());
}

TEST_F(Folder, ALinkInItsPlaceIsNotFollowed) {
    std::filesystem::create_directory_symlink(name, name + "-link");
    EXPECT_THROW(PictureStore(name + "-link"), std::runtime_error);
    EXPECT_NO_THROW(PictureStore(name + "-link/")); // that one is meant
    std::filesystem::remove(name + "-link");
}

TEST_F(Folder, AViewDoesNotLeadOutOfIt) {
    PictureStore store(name + "/p");
    FrameResult odd = frame(1, 0.9);
    odd.view = "/../../evil";
    store.add(odd, pictures(10));
    EXPECT_FALSE(full(store, odd).empty());
    for (const std::string& file : files())
        EXPECT_THAT(file, testing::AnyOf(testing::EndsWith("/p"), HasSubstr("/p/0001.%2f%2e%2e")));
}

TEST(Page, NamesAreOnlyText) {
    const std::string evil = "</script><img src=x onerror=alert(1)>.exr";
    FrameResult missing;
    missing.frame = 1;
    missing.view = evil;
    missing.status = Status::Missing;
    missing.message = "no file \"" + evil + "\" \xff";
    missing.reference = missing.test = evil;
    ShotResult found = shot({missing});
    found.check = {evil, "{{data}}"};
    const std::string page = report_page(found, PictureStore());
    EXPECT_THAT(page, Not(HasSubstr("<img src=x")));
    EXPECT_EQ(count(page, "</script>"), count(page, "<script"));
    const nlohmann::json data = data_of(page);
    EXPECT_EQ(data["shot"]["frames"][0]["test"], evil);
    EXPECT_EQ(data["shot"]["verdict"], "missing");
    EXPECT_EQ(data["about"][0][1], "tonetool " + evil + " {{data}}");
}

TEST(Page, NothingInItNamesAnotherPlace) {
    const std::string page = report_page(shot({frame(1, 0.2)}), PictureStore());
    const std::string head = page.substr(0, page.find("id=\"result\""));
    EXPECT_THAT(head, Not(HasSubstr("http:")));
    EXPECT_THAT(head, Not(HasSubstr("https:")));
    EXPECT_THAT(head, Not(HasSubstr("src=")));
    EXPECT_THAT(page, HasSubstr("Content-Security-Policy"));
}

TEST(Page, TheSameShotGivesTheSameBytes) {
    PictureStore store;
    store.add(frame(1, 0.9), pictures(100));
    const ShotResult found = shot({frame(1, 0.9), frame(2, 0.1)});
    EXPECT_EQ(report_page(found, store), report_page(found, store));
}

TEST(Page, AThousandFramesStayBelow60MegabytesAndThePageSaysWhatIsKept) {
    PictureStore store;
    std::vector<FrameResult> frames;
    for (int i = 0; i < 1000; ++i) {
        frames.push_back(frame(i, 0.75 - 0.0005 * i)); // the worst first
        store.add(frames.back(), pictures(i < 30 ? 4 << 20 : 1000, 30000));
    }
    const std::string page = report_page(shot(frames), store);
    EXPECT_LT(page.size(), 60e6);
    const size_t full = count(page, "id=\"full-"), small = count(page, "id=\"small-");
    EXPECT_EQ(full, 7U);
    EXPECT_EQ(count(page, "id=\"full-0\""), 1U);
    EXPECT_EQ(count(page, "id=\"small-0\""), 1U);
    EXPECT_THAT(data_of(page)["about"].dump(),
                AllOf(HasSubstr("in full of 7 of 1000 frames, the worst first, of 0 of them"),
                      HasSubstr("thumbnails of " + std::to_string(small))));
}

TEST(Page, PicturesOfTheFullSizeTakeThePlaceOfReducedOnesWhereAllOthersFit) {
    PictureStore store;
    std::vector<FrameResult> frames;
    for (int i = 0; i < 14; ++i) {
        FramePictures drawn = pictures(1000);
        drawn.large = {"", "data:large-" + std::string(i == 1 ? 3 << 20 : 2000, 'A')};
        frames.push_back(frame(i, 0.9 - 0.01 * i));
        store.add(frames.back(), drawn);
    }
    PageLimits limits;
    limits.bytes = size_t(3) << 20; // the second frame's does not fit
    const std::string page = report_page(shot(frames), store, limits);
    EXPECT_LT(page.size(), limits.bytes);
    EXPECT_EQ(count(page, "id=\"full-"), 14U);
    EXPECT_EQ(count(page, "id=\"large-"), 11U); // of the twelve worst
    EXPECT_EQ(count(page, "id=\"large-1\""), 0U);
    EXPECT_EQ(count(page, "\"pictures\":{\"reference\":\"data:"), 3U);
}

TEST_F(Folder, PicturesOfAnEarlierFormAreNotUsedAndThatIsSaid) {
    fs::write_text_file(name + "/0001.small.json", "{\"of\":\"0123456789abcdef\",\"test\":\"x\"}");
    PictureStore store(name);
    EXPECT_THAT(store.complaint(), HasSubstr("in the form of an earlier version"));
    EXPECT_FALSE(store.restore(frame(1, 0.9)));
    store.add(frame(1, 0.9), pictures(10));
    EXPECT_TRUE(store.restore(frame(1, 0.9)));
    EXPECT_EQ(PictureStore(name).complaint(), "");
}

TEST_F(Folder, NumbersOfMoreFramesThanWereDrawnAreDrawnAnew) {
    PictureStore(name).add(frame(1, 0.9), pictures(10));
    PictureCounts more;
    more.exact = 2;
    EXPECT_FALSE(PictureStore(name, more).restore(frame(1, 0.9)));
    EXPECT_FALSE(full(PictureStore(name, more), frame(1, 0.9)).empty()); // a merge takes them
}

FrameResult faulty(int number, const Fault& fault) {
    FrameResult result = frame(number, 0.1);
    result.faults = {fault};
    judge(result);
    return result;
}

std::string sentence(const std::vector<FrameResult>& frames) {
    const std::string page = report_page(shot(frames), PictureStore()),
                      open = "class=\"sentence\">";
    const size_t begin = page.find(open) + open.size();
    return page.substr(begin, page.find('<', begin) - begin);
}

TEST(Page, TheFirstSentenceSaysWhichFramesNeedALookAndWhy) {
    const Fault spot{"firefly", Severity::Warning, "A firefly.", "", Position{3, 4}, {}, {}};
    const Fault layer{"blacklayer", Severity::Error, "It is black.", "neon", {}, {}, {}};
    FrameResult missing;
    missing.status = Status::Missing;
    std::vector<FrameResult> frames{frame(1, 0.1), faulty(2, spot), faulty(3, layer),
                                    frame(4, 0.7)};
    for (const int number : {7, 8, 10}) {
        missing.frame = number;
        frames.push_back(missing);
    }
    EXPECT_EQ(sentence(frames),
              "6 of 7 frames need a look: frames 7-8: missing; frame 10: missing; "
              "frame 3: blacklayer in neon; frame 4: hdrflip: p99 0.7 &gt; 0.5; "
              "frame 2: firefly (at 3,4)");
    EXPECT_EQ(sentence({frame(1, 0.1)}), "No frame needs a look.");
}

TEST(Page, SpotsThatTurnedOutToBeNoFaultAreLeftOut) {
    PictureStore store;
    FrameResult spotted = frame(1, 0.9);
    spotted.measurements[0].worst = Position{5, 6};
    FramePictures drawn = pictures(10);
    drawn.spots = {{{1, 2}, "", "data:spot-a", ""},
                   {{3, 4}, "", "data:spot-b", ""},
                   {{5, 6}, "", "data:spot-c", ""}};
    store.add(spotted, drawn);
    spotted.faults = {{"nan", Severity::Error, "NaN.", "", Position{3, 4}, {}, {}}};
    const std::string page = report_page(shot({spotted}), store);
    EXPECT_EQ(count(page, "data:spot-a"), 0U);
    EXPECT_EQ(count(page, "data:spot-b"), 2U); // small and full
    EXPECT_EQ(count(page, "data:spot-c"), 2U);
}

TEST(Page, VeryManyFramesHaveNoHistogramsButTheWorstOnes) {
    PictureStore store;
    std::vector<FrameResult> frames{frame(0, 0.9)};
    store.add(frames[0], pictures(10));
    for (int i = 1; i < 20; ++i)
        frames.push_back(frame(i, 0.1));
    PageLimits limits;
    limits.detailed_frames = 10;
    const nlohmann::json all = data_of(report_page(shot(frames), store, limits))["shot"]["frames"];
    EXPECT_TRUE(all[0]["measurements"][0].contains("histogram"));
    EXPECT_FALSE(all[1]["measurements"][0].contains("histogram"));
    EXPECT_TRUE(all[1]["measurements"][0].contains("quantities"));
}

TEST_F(Folder, ABrokenFileOfPicturesIsLeftOut) {
    PictureStore store(name);
    store.add(frame(1, 0.9), pictures(10));
    const std::string text = full(store, frame(1, 0.9));
    fs::write_text_file(name + "/0001.full.json", text.substr(0, 40));
    fs::write_text_file(name + "/0001.small.json", small(store, frame(1, 0.9)) + "</script><b>");
    const std::string page = report_page(shot({frame(1, 0.9)}), store);
    EXPECT_EQ(count(page, "id=\"full-"), 0U);
    EXPECT_EQ(count(page, "id=\"small-"), 0U);
}

TEST(Sheet, ACellForEachFrameAlsoWithoutAPicture) {
    FrameResult missing;
    missing.frame = 3;
    missing.status = Status::Missing;
    std::string warning;
    const OIIO::ImageBuf one = contact_sheet(shot({missing}), PictureStore(), warning);
    const OIIO::ImageBuf four = contact_sheet(
        shot({missing, frame(1, 0.1), frame(2, 0.1), frame(4, 0.9)}), PictureStore(), warning);
    EXPECT_NEAR(four.spec().width, one.spec().width * 2, 20);
    EXPECT_NEAR(four.spec().height, one.spec().height * 2, 20);
    EXPECT_EQ(four.nchannels(), 3);
    EXPECT_THROW(contact_sheet(shot({}), PictureStore(), warning), std::runtime_error);
}

TEST(Sheet, MoreFramesThanFitAreTheWorstAndItSaysSo) {
    std::vector<FrameResult> frames;
    for (int i = 0; i < int(kMostSheetFrames) + 1; ++i)
        frames.push_back(frame(i, 0.1));
    std::string warning;
    contact_sheet(shot(frames), PictureStore(), warning);
    EXPECT_THAT(warning, HasSubstr("400 worst of 401 frames"));
}

} // namespace
} // namespace tonetool::sequence
