#pragma once
#include <hagen/recording/SensorTurns.h>
#include <hagen/recording/TurnRecorder.h>

namespace hagen::recording {

/// Records the packets that a session sends through a socket (RecorderLink.h) until it ends, or
/// recording fails.
live::Recorded recordPackets(int socket, SensorTurns& turns, TurnRecorder& recorder);

}  // namespace hagen::recording
