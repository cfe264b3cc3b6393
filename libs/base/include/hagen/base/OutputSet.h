#pragma once
#include <deque>
#include <filesystem>
#include <functional>
#include <string>

#include "OutputPath.h"

namespace hagen::base {

/// The outputs of one run. One that cannot be written, or cannot get its name, is given up with its
/// reason, and the others go on.
class OutputSet {
 public:
    void add(OutputPath& output) { add(output, output); }
    /// Any other output that has a commit(), by its place. Each is to live as long as the set.
    template <class Output>
    void add(const OutputPath& place, Output& output) {
        members_.push_back({place.path(), [&output] { output.commit(); }});
    }

    /// Calls what writes an output, or a part of it, to its temporary place, unless the output was
    /// given up. The output is one that was added.
    void write(const OutputPath& output, const std::function<void()>& step);

    /// Whether no output is left to write.
    bool areAllGivenUp() const;
    /// Why outputs were given up; "" if none was.
    const std::string& failures() const { return failures_; }

    /// Has the outputs that are left get their names, in the order in which they were added and
    /// with a RenamingNote. Throws std::runtime_error with each reason if any was given up.
    void commit();

 private:
    struct Member {
        std::filesystem::path path;
        std::function<void()> commit;
        bool is_given_up = false;
    };

    /// Messages name the output, not its temporary place.
    void attempt(Member& member, const std::function<void()>& step);

    std::deque<Member> members_;
    std::string failures_;
};

}  // namespace hagen::base
