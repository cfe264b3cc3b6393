#pragma once
#define MRPT_VERSION 0x030102
