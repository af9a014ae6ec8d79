//! Prints the cycles that the frames of each bench scene take on a board with 100 KB of RAM, by its
//! own counter: see `tests/measure/BOARDS.md`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::entry!(firmware::bench::board);
