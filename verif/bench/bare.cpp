// SPDX-License-Identifier: Apache-2.0
//
// bare: the Verilated core_tb without cocotb, driven by the shortest loop there is. It links the same
// objects as the cocotb build, draws the same frame and prints "cycles cpu_seconds hash", the hash (FNV-1a)
// being that of the pixels' bytes r, g, b in picture order.
//
// Usage: bare width height tan_h tan_v depth frame.hex

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

#include "Vtop.h"
#include "verilated.h"

static std::vector<uint32_t> read_words(const char *path) {
    std::ifstream file(path);
    std::vector<uint32_t> words;
    for (std::string line; std::getline(file, line);) {
        line = line.substr(0, line.find("//"));
        const auto start = line.find_first_not_of(" \t\r");
        if (start != std::string::npos) words.push_back(std::stoul(line.substr(start), nullptr, 16));
    }
    return words;
}

int main(int argc, char **argv) {
    if (argc != 7) return 2;
    Verilated::commandArgs(argc, argv);
    Vtop top;
    const std::vector<uint32_t> words = read_words(argv[6]);
    top.width = std::atoi(argv[1]);
    top.height = std::atoi(argv[2]);
    top.tan_h = std::atoi(argv[3]);
    top.tan_v = std::atoi(argv[4]);
    top.depth = std::atoi(argv[5]);
    top.go = 1;
    top.probe_on = 0;
    top.s_axis_frame_tvalid = 0;
    top.m_axis_video_tready = 1;
    // The clock runs in core_tb: one slot of time is a rising edge, the next one a falling edge.
    VerilatedContext *const context = top.contextp();
    const auto clock = [&top, context] {
        for (int edge = 0; edge < 2; ++edge) {
            context->time(top.nextTimeSlot());
            top.eval();
        }
    };
    top.eval();
    top.rst = 1;
    clock();
    clock();
    top.rst = 0;
    clock();

    uint64_t cycles = 0;
    uint64_t hash = 14695981039346656037ull;
    size_t next = 0;
    const std::clock_t start = std::clock();
    for (bool done = false; !done; ++cycles) {
        // Ready depends on registers only, so it holds for the edge to come.
        top.s_axis_frame_tvalid = next < words.size();
        if (next < words.size()) {
            top.s_axis_frame_tdata = words[next];
            top.s_axis_frame_tlast = next + 1 == words.size();
            next += top.s_axis_frame_tready;
        }
        if (top.m_axis_video_tvalid)
            for (int shift = 16; shift >= 0; shift -= 8)
                hash = (hash ^ (top.m_axis_video_tdata >> shift & 255)) * 1099511628211ull;
        done = top.frame_done || top.frame_error;
        clock();
    }
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    std::printf("%llu %.6f %016llx\n", static_cast<unsigned long long>(cycles), seconds,
                static_cast<unsigned long long>(hash));
    return 0;
}
