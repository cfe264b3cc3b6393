#pragma once
#include <deque>
#include <filesystem>
#include <functional>
#include <string>

#include <hagen/base/OutputPath.h>

namespace hagen::base {

/// The outputs of one run. If an output fails, its error is kept and the others continue.
class OutputSet {
 public:
    void add(OutputPath& output) { add(output, output); }
    /// Adds an object whose commit() completes the output at `place`. Outputs must outlive the set.
    template <class Output>
    void add(const OutputPath& place, Output& output) {
        members_.push_back({place.path(), [&output] { output.commit(); }});
    }

    /// Runs a step that writes an output, unless the output has failed. Throws std::logic_error if
    /// the output was not added.
    void write(const OutputPath& output, const std::function<void()>& step);

    /// True if all outputs have failed.
    bool areAllGivenUp() const;
    /// The errors of failed outputs; "" if there are none.
    const std::string& failures() const { return failures_; }

    /// Commits the remaining outputs in the order in which they were added. Throws
    /// std::runtime_error with all errors if any output has failed.
    void commit();

 private:
    struct Member {
        std::filesystem::path path;
        std::function<void()> commit;
        bool is_given_up = false;
    };

    /// Replaces temporary file names in error messages with the output's name.
    void attempt(Member& member, const std::function<void()>& step);

    std::deque<Member> members_;
    std::string failures_;
};

}  // namespace hagen::base
