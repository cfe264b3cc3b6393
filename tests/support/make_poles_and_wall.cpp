// Creates rawlogs/poles_and_wall.rawlog: a low flight of a level VLP-16 between two rows of poles
// towards a wall, over flat ground. Usage: make-poles-and-wall OUT.rawlog
#include <mrpt/obs/CObservationRobotPose.h>
#include "convert/RawlogWriter.h"

#include <cstdio>
#include <exception>

#include "support/PolesAndWall.h"

int main(int argc, char** argv) {
    if (argc != 2 || argv[1][0] == '-') {  // --help is not a file name
        std::fprintf(stderr, "usage: make-poles-and-wall OUT.rawlog\n");
        return 2;
    }
    try {
        hagen::convert::RawlogWriter writer(argv[1], true);
        for (int scan = 0; scan < hagen::test::kPolesAndWallScans; ++scan) {
            writer.write(*hagen::test::polesAndWallPose(scan));
            writer.write(*hagen::test::polesAndWallScan(scan));
        }
        writer.write(*hagen::test::polesAndWallPose(hagen::test::kPolesAndWallScans));
        writer.commit();
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "make-poles-and-wall: %s\n", e.what());
        return 1;
    }
}
