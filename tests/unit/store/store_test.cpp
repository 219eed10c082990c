// SPDX-License-Identifier: BSD-3-Clause
#include "store/store.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <iostream>
#include <random>
#include <sys/wait.h>
#include <unistd.h>

#include "store/files.h"
#include "store/sha256.h"

namespace tonetool::store {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The examples of FIPS 180-4 (and the hash of nothing), as NIST publishes them.
TEST(Sha256, Fips) {
    EXPECT_EQ(sha256_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(sha256_of(std::string(1000000, 'a')),
              "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, PartsOfAnySizeAreTheWhole) {
    std::string text;
    for (int i = 0; i < 1000; ++i)
        text += char('a' + i % 23);
    for (const size_t part : {1, 3, 63, 64, 65, 200}) {
        Sha256 hash;
        for (size_t at = 0; at < text.size(); at += part)
            hash.add(text.data() + at, std::min(part, text.size() - at));
        EXPECT_EQ(hash.digits(), sha256_of(text)) << part;
    }
}

class StoreTest : public ::testing::Test {
protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "tonetool-store.XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        m_place = name;
        m_folder = m_place + "/approved";
    }
    void TearDown() override { fs::remove_all(m_place); }

    std::string image(const std::string& text, const std::string& name = "render.exr") const {
        std::ofstream(m_place + "/" + name, std::ios::binary) << text;
        return m_place + "/" + name;
    }
    Approval approval(const std::string& name, const std::string& text, const std::string& key = "",
                      bool add = false) const {
        return {name, image(text), sha256_of(text), key, "Ada", "2026-11-28T16:40:00Z", "why", add};
    }
    std::vector<std::string> files() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::recursive_directory_iterator(m_folder))
            if (!entry.is_directory() && entry.path().filename() != ".tonetool.lock")
                names.push_back(fs::relative(entry.path(), m_folder).string());
        std::sort(names.begin(), names.end());
        return names;
    }

    std::string m_place, m_folder;
};

std::string refusal(const std::function<void()>& run) {
    try {
        run();
    } catch (const std::runtime_error& problem) {
        return problem.what();
    }
    return "";
}

TEST_F(StoreTest, AnApprovalHasARecordAndItsImage) {
    Store store(m_folder);
    EXPECT_THAT(store.names(), IsEmpty());
    store.approve({approval("hair/long", "one")});
    const std::string hash = sha256_of("one");
    EXPECT_THAT(files(),
                ElementsAre("hair/long." + hash.substr(0, 12) + ".exr", "hair/long.approved.json"));
    EXPECT_EQ(
        read_file(m_folder + "/hair/long.approved.json"),
        "{\n \"format\": \"tonetool-approved\",\n \"version\": 1,\n \"images\": [\n  {\n"
        "   \"key\": \"\",\n   \"file\": \"long." +
            hash.substr(0, 12) +
            ".exr\",\n"
            "   \"sha256\": \"" +
            hash +
            "\",\n   \"bytes\": 3,\n   \"by\": \"Ada\",\n"
            "   \"at\": \"2026-11-28T16:40:00Z\",\n   \"reason\": \"why\",\n   \"replaces\": []\n"
            "  }\n ]\n}\n");
    EXPECT_THAT(store.names(), ElementsAre("hair/long"));
    EXPECT_THAT(store.problems(), IsEmpty());
}

TEST_F(StoreTest, AnotherReplacesItUnlessItIsAdded) {
    Store store(m_folder);
    store.approve({approval("a", "one")});
    store.approve({approval("a", "two")});
    ASSERT_EQ(store.accepted("a", "").size(), 1U);
    EXPECT_THAT(store.accepted("a", "").front().replaces, ElementsAre(sha256_of("one")));
    EXPECT_EQ(files().size(), 2U); // the image of before is gone
    store.approve({approval("a", "three", "", true)});
    EXPECT_EQ(store.accepted("a", "").size(), 2U);
    store.approve({approval("a", "gpu", "cuda")});
    ASSERT_EQ(store.accepted("a", "cuda").size(), 1U);
    EXPECT_EQ(store.accepted("a", "cuda").front().key, "cuda");
    EXPECT_EQ(store.accepted("a", "metal").size(), 2U); // those without a key
    EXPECT_THAT(store.problems(), IsEmpty());
}

TEST_F(StoreTest, OtherBytesAreNotApproved) {
    Store store(m_folder);
    store.approve({approval("a", "one")});
    const ApprovedImage found = store.accepted("a", "").front();
    std::ofstream(store.file("a", found)) << "two";
    EXPECT_EQ(store.look("a", found), Found::Other);
    EXPECT_THAT(store.problems(), ElementsAre(HasSubstr("is not what was approved")));
    std::ofstream(store.file("a", found))
        << "version https://git-lfs.github.com/spec/v1\noid sha256:" << sha256_of("one")
        << "\nsize 3\n";
    EXPECT_EQ(store.look("a", found), Found::NotFetched);
    EXPECT_THAT(store.problems(), ElementsAre(HasSubstr("git lfs pull")));
    std::ofstream(store.file("a", found))
        << "version https://git-lfs.github.com/spec/v1\noid sha256:" << sha256_of("two")
        << "\nsize 3\n";
    EXPECT_EQ(store.look("a", found), Found::Other);
    fs::remove(store.file("a", found));
    EXPECT_EQ(store.look("a", found), Found::Gone);
    std::ofstream(m_folder + "/stray.exr") << "x";
    EXPECT_THAT(store.problems(), ElementsAre(HasSubstr("not there"), HasSubstr("has no record")));
}

TEST_F(StoreTest, WhatHasChangedIsNotApproved) {
    Store store(m_folder);
    Approval changed = approval("b", "one");
    changed.sha256 = sha256_of("two");
    EXPECT_THAT(refusal([&] {
                    store.approve({approval("a", "one"), changed});
                }),
                HasSubstr("has changed since the run"));
    EXPECT_THAT(store.names(), IsEmpty()); // nothing half
}

TEST_F(StoreTest, NamesStayInTheStore) {
    Store store(m_folder);
    for (const char* name : {"", "/etc/a", "a//b", "../a", "a/../b", ".a", "a/", "a/.b"})
        EXPECT_THAT(refusal([&] { store.approve({approval(name, "x")}); }), HasSubstr("is no name"))
            << name;
    EXPECT_THAT(refusal([&] { store.approve({approval("a", "x", "a/b")}); }), HasSubstr("the key"));
    fs::create_directories(m_folder);
    std::ofstream(m_folder + "/a.approved.json")
        << R"({"format":"tonetool-approved","version":1,"images":[{"key":"","file":"../x.exr",)"
        << "\"sha256\":\"" << sha256_of("x") << R"(","bytes":1,"by":"","at":"","reason":""}]})";
    EXPECT_THAT(refusal([&] { (void)store.find("a"); }), HasSubstr("none beside it"));
    for (const char* text : {"", "{}", "[]", R"({"format":"tonetool-approved","version":2})"})
        EXPECT_NE(refusal([&] { (void)record_from(text); }), "") << text;
}

TEST_F(StoreTest, RetiredCasesAreGone) {
    Store store(m_folder);
    store.approve({approval("a", "one"), approval("b", "one")});
    EXPECT_THAT(refusal([&] { store.retire({"c"}); }), HasSubstr("nothing is approved for \"c\""));
    store.retire({"a"});
    EXPECT_THAT(store.names(), ElementsAre("b"));
    EXPECT_EQ(files().size(), 2U);
}

// Runs `work` in a process of its own; its id.
pid_t in_process(const std::function<void()>& work) {
    const pid_t child = ::fork();
    if (child == 0) {
        try {
            work();
        } catch (const std::exception& problem) {
            std::cerr << problem.what() << std::endl;
            ::_exit(1);
        }
        ::_exit(0);
    }
    return child;
}

TEST_F(StoreTest, KilledAtAnyMomentItIsWhole) {
    std::mt19937 random(7);
    Store(m_folder).approve({approval("a", "first")});
    for (int round = 0; round < 60; ++round) {
        const std::string text(200000, char('a' + round % 26));
        const Approval next = approval("a", text + std::to_string(round));
        const pid_t child = in_process([&] { Store(m_folder).approve({next}); });
        ::usleep(useconds_t(random() % 3000));
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
        const auto images = Store(m_folder).accepted("a", "");
        ASSERT_EQ(images.size(), 1U);
        ASSERT_EQ(Store(m_folder).look("a", images.front()), Found::Approved) << round;
    }
    Store(m_folder).approve({approval("a", "last")});
    EXPECT_EQ(files().size(), 2U); // what killed runs have left is gone
    EXPECT_THAT(Store(m_folder).problems(), IsEmpty());
}

TEST_F(StoreTest, EightAtOnceLoseNothing) {
    constexpr int processes = 8, approvals = 10;
    std::vector<pid_t> children;
    for (int p = 0; p < processes; ++p) {
        const auto work = [this, p] {
            for (int i = 0; i < approvals; ++i) {
                const std::string text = std::to_string(p) + "-" + std::to_string(i);
                const std::string file = image(text, "render" + std::to_string(p) + ".exr");
                Store(m_folder).approve(
                    {{"a" + std::to_string(i), file, sha256_of(text), "", "p", "t", "w", true}});
            }
        };
        children.push_back(in_process(work));
    }
    for (const pid_t child : children) {
        int status = 1;
        ::waitpid(child, &status, 0);
        EXPECT_EQ(status, 0);
    }
    const Store store(m_folder);
    size_t kept = 0;
    for (const std::string& name : store.names())
        kept += store.accepted(name, "").size();
    EXPECT_EQ(kept, size_t(processes * approvals));
    EXPECT_THAT(store.problems(), IsEmpty());
}

} // namespace
} // namespace tonetool::store
