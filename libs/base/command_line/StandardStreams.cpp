#include "base/command_line/StandardStreams.h"

#include <fcntl.h>
#include <unistd.h>

#include <initializer_list>

namespace hagen::base {

void reserveStandardStreams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(stream, F_GETFD) != -1) continue;
        // The lowest free number is this one: those below are open.
        if (open("/dev/null", O_RDWR) == -1) continue;
    }
}

}  // namespace hagen::base
