//! Loops for Hazard3.
//!
//! A branch back misses its prediction at the first turn and at the end, and takes 2 there, else 1.

use super::Loop;
use crate::cores::Core::Riscv;

pub(super) const LOOPS: &[Loop] = &[
    Loop {
        name: "countdown",
        code: &[
            0x4579, //   li a0, 30
            0x157d, // l: addi a0, a0, -1
            0xfd7d, //   bnez a0, l
        ],
        instructions: 1 + 30 * 2,
        cycles: &[(Riscv, &[1 + 30 + (2 + 28 + 2)])],
    },
    Loop {
        name: "load and use",
        code: &[
            0x4551, //   li a0, 20
            0x4194, // l: lw a3, 0(a1)
            0x9736, //   add a4, a4, a3
            0x157d, //   addi a0, a0, -1
            0xfd6d, //   bnez a0, l
        ],
        instructions: 1 + 20 * 4,
        cycles: &[(Riscv, &[1 + 20 * (2 + 1 + 1) + (2 + 18 + 2)])],
    },
    Loop {
        name: "calls",
        code: &[
            0x4551, //   li a0, 20
            0x2021, // l: jal f
            0x157d, //   addi a0, a0, -1
            0xfd75, //   bnez a0, l
            0xa011, //   j e
            0x8082, // f: ret
                    // e:
        ],
        instructions: 1 + 20 * 4 + 1,
        cycles: &[(Riscv, &[1 + 20 * (2 + 2 + 1) + (2 + 18 + 2) + 2])],
    },
    Loop {
        name: "divide",
        code: &[
            0x4529, //   li a0, 10
            0x469d, //   li a3, 7
            0xd733, 0x02a6, // l: divu a4, a3, a0
            0x157d, //   addi a0, a0, -1
            0xfd6d, //   bnez a0, l
        ],
        instructions: 2 + 10 * 3,
        cycles: &[(Riscv, &[2 + 10 * (18 + 1) + (2 + 8 + 2)])],
    },
    Loop {
        name: "target off a word",
        code: &[
            0x4529, //   li a0, 10
            0x469d, //   li a3, 7
            0x0001, //   nop
            0x8733, 0x02a6, // l: mul a4, a3, a0
            0x157d, //   addi a0, a0, -1
            0xfd6d, //   bnez a0, l
        ],
        instructions: 3 + 10 * 3,
        // One more for each of nine jumps back.
        cycles: &[(Riscv, &[3 + 10 * (1 + 1) + (2 + 8 + 2) + 9])],
    },
];
