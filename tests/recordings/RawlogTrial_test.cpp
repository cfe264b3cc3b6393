// Tests of the read-ahead child process, including when a lock that is never released blocks it.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/time.h>
#include "convert/RawlogWriter.h"

#include <fstream>
#include <future>

#include "recordings/rawlogs/RawlogTrial.h"
#include "support/Program.h"
#include "support/ReadRawlog.h"

namespace hagen::recordings {
namespace {

using testing::AllOf;
using testing::HasSubstr;

namespace fs = std::filesystem;

/// An object that takes more CPU time to read than the idle timeout.
class SlowObject : public mrpt::serialization::CSerializable {
    DEFINE_SERIALIZABLE(SlowObject, hagen::recordings)
};
IMPLEMENTS_SERIALIZABLE(SlowObject, CSerializable, hagen::recordings)

std::uint8_t SlowObject::serializeGetVersion() const { return 0; }
void SlowObject::serializeTo(mrpt::serialization::CArchive&) const {}
void SlowObject::serializeFrom(mrpt::serialization::CArchive&, std::uint8_t) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(600);
    while (std::chrono::steady_clock::now() < end) {
    }
}

/// An object that blocks forever when read, as on a lock held by another thread during fork(): once
/// per file in `locks`.
class LockedObject : public mrpt::serialization::CSerializable {
    DEFINE_SERIALIZABLE(LockedObject, hagen::recordings)
};
IMPLEMENTS_SERIALIZABLE(LockedObject, CSerializable, hagen::recordings)

fs::path locks;

std::uint8_t LockedObject::serializeGetVersion() const { return 0; }
void LockedObject::serializeTo(mrpt::serialization::CArchive&) const {}
void LockedObject::serializeFrom(mrpt::serialization::CArchive&, std::uint8_t) {
    if (fs::is_empty(locks)) return;
    fs::remove(fs::directory_iterator(locks)->path());
    std::promise<void>().get_future().wait();
}

class RawlogTrialTest : public testing::Test {
 protected:
    RawlogTrialTest() {
        mrpt::rtti::registerClass(CLASS_ID(LockedObject));
        locks = folder_ / "locks";
        fs::create_directory(locks);
        convert::RawlogWriter writer(folder_ / "a.rawlog", false);
        writer.write(test::comment("before"));
        writer.write(test::comment(std::string(3'000'000, 'x')));  // more than a pipe holds
        writer.write(LockedObject());
        writer.write(test::comment("after"));
        writer.commit();
    }

    /// The verdicts on all entries if the reader blocks `times` times.
    std::vector<EntryVerdict> verdicts(int times) {
        for (int i = 0; i < times; ++i) std::ofstream(locks / std::to_string(i)) << 'x';
        std::vector<EntryVerdict> verdicts;
        RawlogTrial trial(folder_ / "a.rawlog", std::chrono::milliseconds(400));
        do verdicts.push_back(trial.next());
        while (verdicts.back().kind == EntryVerdict::Kind::Sound);
        return verdicts;
    }

    test::TemporaryFolder folder_;
};

TEST_F(RawlogTrialTest, RestartsIdleProcess) {
    const auto expected = verdicts(0);
    ASSERT_EQ(expected.size(), 5u);
    for (std::size_t entry = 0; entry < 4; ++entry) {
        const std::uint64_t start = entry == 0 ? 0 : expected[entry - 1].end;
        EXPECT_EQ(expected[entry].bytes.size(), expected[entry].end - start);
    }
    for (const int times : {1, 2}) {
        const auto found = verdicts(times);
        ASSERT_EQ(found.size(), 5u);
        for (std::size_t entry = 0; entry < 5; ++entry) {
            EXPECT_EQ(found[entry].kind, expected[entry].kind);
            EXPECT_EQ(found[entry].end, expected[entry].end);
            EXPECT_EQ(found[entry].bytes, expected[entry].bytes);
        }
        EXPECT_TRUE(fs::is_empty(locks));
    }
}

TEST_F(RawlogTrialTest, WaitsForSlowReader) {
    mrpt::rtti::registerClass(CLASS_ID(SlowObject));
    convert::RawlogWriter writer(folder_ / "a.rawlog", true);
    for (int i = 0; i < 2; ++i) writer.write(SlowObject());
    writer.commit();
    const auto found = verdicts(0);
    EXPECT_EQ(found.size(), 3u);
    EXPECT_EQ(found.back().kind, EntryVerdict::Kind::End);
}

/// The signals of an interval timer interrupt system calls.
TEST_F(RawlogTrialTest, IgnoresSignalsWhileWaiting) {
    struct sigaction none {
    }, before{};
    none.sa_handler = [](int) {};
    sigaction(SIGALRM, &none, &before);
    const itimerval often{{0, 10000}, {0, 10000}}, never{};
    setitimer(ITIMER_REAL, &often, nullptr);
    const auto found = verdicts(1);
    setitimer(ITIMER_REAL, &never, nullptr);
    sigaction(SIGALRM, &before, nullptr);
    EXPECT_EQ(found.size(), 5u);
    EXPECT_TRUE(fs::is_empty(locks));
}

TEST_F(RawlogTrialTest, FailsAfterThreeStarts) {
    const auto found = verdicts(10);
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found[2].kind, EntryVerdict::Kind::Broken);
    EXPECT_EQ(found[2].end, found[1].end);
    EXPECT_THAT(found[2].why,
                AllOf(HasSubstr("a.rawlog: entry 2 at byte " + std::to_string(found[1].end)),
                      HasSubstr("MRPT's reader hangs")));
    EXPECT_EQ(std::distance(fs::directory_iterator(locks), {}), 10 - RawlogTrial::kMaxStarts);
}

}  // namespace
}  // namespace hagen::recordings
