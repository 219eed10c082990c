// SPDX-License-Identifier: BSD-3-Clause
#include "runs/runs.h"

#include <gmock/gmock.h>
#include <sstream>

#include "runs/frames.h"

namespace tonetool::runs {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

struct Ran {
    int status;
    std::string out, err;
};

Ran run_words(const Strings& words) {
    std::ostringstream out, err;
    int status = run(words, out, err);
    return {status, out.str(), err.str()};
}

TEST(CommandLine, CompatIsACommandAndNotAnArgument) {
    for (const Strings& words :
         {Strings{"-compat"}, Strings{"a.exr", "--compat"},
          Strings{"--parallel-frames", "--compat"}, Strings{"--parallel-frames", "2", "--compat"},
          Strings{"--attrib", "a", "b", "--compat"}})
        EXPECT_TRUE(chain::parse_line(words).compat) << words.front();
    for (const Strings& words : {Strings{"compat"}, Strings{"--echo", "--compat"},
                                 Strings{"--attrib", "note", "--compat"}, Strings{"-o", "-compat"}})
        EXPECT_FALSE(chain::parse_line(words).compat) << words.front();
}

const std::string kPlain = TESTIMAGES_DIR "/plain.exr";

// A file's own type is one for all channels: CHANNEL=TYPE would go unchecked there.
TEST(Run, TheTypeOfOneFileIsOneForAllChannels) {
    for (const char* type : {"R=half", "Q=half", "halves"}) {
        Ran ran = run_words({kPlain, std::string("-o:datatype=") + type, "unwritten.exr"});
        EXPECT_EQ(ran.status, 1) << type;
        EXPECT_THAT(ran.err, HasSubstr("Unknown data format \"" + std::string(type))) << type;
    }
}

TEST(Run, NothingToDoIsAnError) {
    EXPECT_EQ(run_words({}).status, 1);
    Ran ran = run_words({kPlain});
    EXPECT_EQ(ran.status, 1);
    EXPECT_THAT(ran.err, HasSubstr("produced no output"));
    EXPECT_THAT(ran.err, HasSubstr("Full command line was:\n> tonetool " + kPlain));
}

TEST(Run, VersionAndHelpPass) {
    EXPECT_EQ(run_words({"--version"}).status, 0);
    Ran ran = run_words({"--help", "--hdrflip"});
    EXPECT_EQ(ran.status, 0);
    EXPECT_THAT(ran.out, HasSubstr("prescale=X"));
    EXPECT_THAT(ran.err, IsEmpty());
    EXPECT_EQ(run_words({"--help", "hdrflp"}).status, 1);
}

TEST(Run, UnknownCommandNamesNearOnes) {
    Ran ran = run_words({kPlain, "--hdrflp"});
    EXPECT_EQ(ran.status, 1);
    EXPECT_THAT(ran.err, HasSubstr("unknown command \"--hdrflp\", did you mean --hdrflip"));
}

TEST(Run, PendingOperatorAtTheEndIsAnError) {
    Ran ran = run_words({"--info", kPlain, "--hdrflip:fail=0.5"});
    EXPECT_EQ(ran.status, 1);
    EXPECT_THAT(ran.err, HasSubstr("hdrflip : never executed: needs 2 image(s)"));
}

TEST(Run, ForgottenArgumentIsAnError) {
    EXPECT_THAT(run_words({kPlain, "--exposure"}).err, HasSubstr("missing argument STOPS"));
    EXPECT_THAT(run_words({kPlain, "-o", "--dup"}).err, HasSubstr("missing argument FILENAME"));
}

TEST(Run, AStreamThatCannotBeWrittenIsAnError) {
    std::ostringstream out, err;
    out.setstate(std::ios::badbit);
    EXPECT_EQ(run({"--version"}, out, err), 1);
    EXPECT_THAT(err.str(), HasSubstr("standard output"));
}

TEST(Run, StackCommandsNeedTheirImages) {
    for (const char* command : {"--dup", "--swap", "--pop"}) {
        Ran ran = run_words({command});
        EXPECT_EQ(ran.status, 1) << command;
        EXPECT_THAT(ran.err, HasSubstr("needs")) << command;
    }
}

} // namespace
} // namespace tonetool::runs
