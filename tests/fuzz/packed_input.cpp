// gzip and zstd files, read in steps of a size selected by the first byte.
#include "convert/GzipOutput.h"
#include "recordings/rawlogs/PackedInput.h"

#include <optional>
#include <random>

#include "fuzz/Target.h"
#include "support/BagWriter.h"

namespace hagen::fuzz {
namespace {

constexpr std::size_t kMaxBytesRead = 4 << 20;  // a zstd block may repeat a byte without limit

/// Returns nullopt if the file is corrupt: how much is lost before the error depends on the steps.
std::optional<std::string> readInSteps(const std::filesystem::path& file, unsigned seed) {
    std::minstd_rand random(seed);
    recordings::PackedInput input(file);
    std::string all, step;
    for (;;) {
        step.resize(1 + random() % (random() % 8 == 0 ? 1 << 20 : 64));
        const std::size_t got = input.Read(step.data(), step.size());
        all.append(step, 0, got);
        require(input.getPosition() == all.size(), "the position is wrong");
        require(input.packedPosition() <= input.packedBytes(), "more is read than there is");
        if (got < step.size() || all.size() > kMaxBytesRead) break;
    }
    return input.fault().empty() ? std::optional(all) : std::nullopt;
}

void unpack(std::string_view input) {
    Parts parts(input);
    const auto seed = parts.number<std::uint8_t>();
    const InputFile file(parts.rest(), "input.gz");
    const auto one = readInSteps(file.path(), 1), other = readInSteps(file.path(), 2U + seed);
    if (one && one->size() < kMaxBytesRead) require(one == other, "it depends on how it is read");
}

Seeds packedSeeds() {
    std::string plain;
    for (int i = 0; i < 300; ++i) plain += static_cast<char>('a' + i % 7 * (i % 11));
    std::vector<std::uint8_t> gzip;
    convert::packGzipMember({plain.begin(), plain.end()}, gzip);
    const std::string member(gzip.begin(), gzip.end());
    const std::string zstd = test::packed(plain, "zstd");
    return {'\0' + plain, '\0' + member, '\1' + member + member + std::string(5, '\0'), '\2' + zstd,
            '\3' + zstd + zstd};
}

const bool kAdded = add({"packed_input",
                         unpack,
                         packedSeeds,
                         {"\x1f\x8b\x08", "\x28\xb5\x2f\xfd", "\x50\x2a\x4d\x18"},
                         2000});

}  // namespace
}  // namespace hagen::fuzz
