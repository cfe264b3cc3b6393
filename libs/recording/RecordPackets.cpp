#include <hagen/live/RecorderLink.h>
#include <hagen/recording/RecordPackets.h>

namespace hagen::recording {
namespace {

void record(SensorTurns& turns, TurnRecorder& recorder) {
    for (const auto& turn : turns.complete()) recorder.add(turn);
    turns.complete().clear();
}

}  // namespace

live::Recorded recordPackets(int socket, SensorTurns& turns, TurnRecorder& recorder) {
    live::PacketReader reader(socket);
    live::Packet packet;
    while (reader.next(packet) && recorder.failure().empty()) {
        turns.add(packet);
        record(turns, recorder);
    }
    turns.finish();
    record(turns, recorder);
    return recorder.finish();
}

}  // namespace hagen::recording
