//! Prints the cycles that the frames of each bench scene take on a board, in bands, by the board's
//! own counter: see `tests/measure/BOARDS.md`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::entry!(firmware::bench::board);
