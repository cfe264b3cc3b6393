// The same for tests of what needs no MRPT.
#pragma once
#include "plain.h"
//
#include <gmock/gmock.h>
#include <gtest/gtest.h>
