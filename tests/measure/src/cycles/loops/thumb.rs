//! Loops for the Cortex-M cores.
//!
//! Cycles are those of the models: one-cycle and 32-cycle multiplier on the M0+; P = 2, 1, 3 on the
//! M4; estimate, least and most on the M33. In the counts by hand a branch taken is written as 2 on
//! the M0+ and `1 + P` on the M4.

use super::Loop;
use crate::cores::Core::{M0plus, M4, M33};

pub(super) const LOOPS: &[Loop] = &[
    Loop {
        name: "countdown",
        code: &[
            0x2064, //   movs r0, #100
            0x3801, // l: subs r0, #1
            0xd1fd, //   bne l
        ],
        instructions: 1 + 100 * 2,
        cycles: &[
            (M0plus, &[1 + 100 + 99 * 2 + 1; 2]),
            (M4, &[1 + 100 + 99 * 3 + 1, 1 + 100 + 99 * 2 + 1, 1 + 100 + 99 * 4 + 1]),
            // The last branch is not taken, and hides behind SUBS.
            (M33, &[1 + 100 + 99 * 2; 3]),
        ],
    },
    Loop {
        name: "copy words",
        code: &[
            0x2032, //   movs r0, #50
            0x6821, // l: ldr r1, [r4]
            0x6029, //   str r1, [r5]
            0x3404, //   adds r4, #4
            0x3504, //   adds r5, #4
            0x3801, //   subs r0, #1
            0xd1f9, //   bne l
        ],
        instructions: 1 + 50 * 6,
        cycles: &[
            (M0plus, &[1 + 50 * (2 + 2 + 3) + 49 * 2 + 1; 2]),
            (
                M4,
                &[
                    1 + 50 * (2 + 1 + 3) + 49 * 3 + 1,
                    1 + 50 * (2 + 1 + 3) + 49 * 2 + 1,
                    1 + 50 * (2 + 1 + 3) + 49 * 4 + 1,
                ],
            ),
            (M33, &[1 + 50 * (1 + 1 + 3) + 49 * 2; 3]),
        ],
    },
    Loop {
        name: "copy by LDM",
        code: &[
            0x2614, //   movs r6, #20
            0xcc0f, // l: ldmia r4!, {r0-r3}
            0xc50f, //   stmia r5!, {r0-r3}
            0x3e01, //   subs r6, #1
            0xd1fb, //   bne l
        ],
        instructions: 1 + 20 * 4,
        cycles: &[
            (M0plus, &[1 + 20 * (5 + 5 + 1) + 19 * 2 + 1; 2]),
            (
                M4,
                &[
                    1 + 20 * (5 + 5 + 1) + 19 * 3 + 1,
                    1 + 20 * (5 + 5 + 1) + 19 * 2 + 1,
                    1 + 20 * (5 + 5 + 1) + 19 * 4 + 1,
                ],
            ),
            (M33, &[1 + 20 * (4 + 4 + 1) + 19 * 2; 3]),
        ],
    },
    Loop {
        name: "calls",
        code: &[
            0x261e, //   movs r6, #30
            0xf000, 0xf803, // l: bl f
            0x3e01, //   subs r6, #1
            0xd1fb, //   bne l
            0xe001, //   b e
            0x4348, // f: muls r0, r1, r0
            0x4770, //   bx lr
            0xbf00, // e: nop
        ],
        instructions: 1 + 30 * 5 + 2,
        cycles: &[
            (
                M0plus,
                &[
                    1 + 30 * (3 + 1 + 2 + 1) + 29 * 2 + 1 + 2 + 1,
                    1 + 30 * (3 + 32 + 2 + 1) + 29 * 2 + 1 + 2 + 1,
                ],
            ),
            (
                M4,
                &[
                    1 + 30 * (3 + 1 + 3 + 1) + 29 * 3 + 1 + 3 + 1,
                    1 + 30 * (2 + 1 + 2 + 1) + 29 * 2 + 1 + 2 + 1,
                    1 + 30 * (4 + 1 + 4 + 1) + 29 * 4 + 1 + 4 + 1,
                ],
            ),
            (
                M33,
                &[
                    1 + 30 * (2 + 2 + 2 + 1) + 29 * 2 + 2 + 1,
                    1 + 30 * (2 + 2 + 2 + 1) + 29 * 2 + 2 + 1,
                    1 + 30 * (3 + 2 + 3 + 1) + 29 * 2 + 2 + 1,
                ],
            ),
        ],
    },
    Loop {
        name: "PUSH and POP",
        code: &[
            0x261e, //   movs r6, #30
            0xf000, 0xf803, // l: bl f
            0x3e01, //   subs r6, #1
            0xd1fb, //   bne l
            0xe001, //   b e
            0xb510, // f: push {r4, lr}
            0xbd10, //   pop {r4, pc}
            0xbf00, // e: nop
        ],
        instructions: 1 + 30 * 5 + 2,
        cycles: &[
            (M0plus, &[1 + 30 * (3 + 3 + 5 + 1) + 29 * 2 + 1 + 2 + 1; 2]),
            (
                M4,
                &[
                    1 + 30 * (3 + 3 + 5 + 1) + 29 * 3 + 1 + 3 + 1,
                    1 + 30 * (2 + 3 + 4 + 1) + 29 * 2 + 1 + 2 + 1,
                    1 + 30 * (4 + 3 + 6 + 1) + 29 * 4 + 1 + 4 + 1,
                ],
            ),
            (
                M33,
                &[
                    1 + 30 * (2 + 2 + 3 + 1) + 29 * 2 + 2 + 1,
                    1 + 30 * (2 + 2 + 3 + 1) + 29 * 2 + 2 + 1,
                    1 + 30 * (3 + 2 + 5 + 1) + 29 * 2 + 2 + 1,
                ],
            ),
        ],
    },
    Loop {
        name: "address from ADDS",
        code: &[
            0x2028, //   movs r0, #40
            0x2200, //   movs r2, #0
            0x3200, // l: adds r2, #0
            0x58a1, //   ldr r1, [r4, r2]
            0x3801, //   subs r0, #1
            0xd1fb, //   bne l
        ],
        instructions: 2 + 40 * 4,
        cycles: &[
            (M0plus, &[2 + 40 * (1 + 2 + 1) + 39 * 2 + 1; 2]),
            (
                M4,
                &[
                    2 + 40 * (1 + 3 + 1) + 39 * 3 + 1,
                    2 + 40 * (1 + 3 + 1) + 39 * 2 + 1,
                    2 + 40 * (1 + 3 + 1) + 39 * 4 + 1,
                ],
            ),
            (M33, &[2 + 40 * (1 + 1 + 1) + 39 * 2; 3]),
        ],
    },
    Loop {
        name: "four loads",
        code: &[
            0x2028, //   movs r0, #40
            0x6821, // l: ldr r1, [r4]
            0x6862, //   ldr r2, [r4, #4]
            0x68a3, //   ldr r3, [r4, #8]
            0x89a6, //   ldrh r6, [r4, #12]
            0x3801, //   subs r0, #1
            0xd1f9, //   bne l
        ],
        instructions: 1 + 40 * 6,
        cycles: &[
            (M0plus, &[1 + 40 * (4 * 2 + 1) + 39 * 2 + 1; 2]),
            (
                M4,
                &[
                    1 + 40 * (2 + 3 + 1) + 39 * 3 + 1,
                    1 + 40 * (2 + 3 + 1) + 39 * 2 + 1,
                    1 + 40 * (2 + 3 + 1) + 39 * 4 + 1,
                ],
            ),
            (M33, &[1 + 40 * (4 + 1) + 39 * 2; 3]),
        ],
    },
    Loop {
        name: "load and use",
        code: &[
            0x2028, //   movs r0, #40
            0x6821, // l: ldr r1, [r4]
            0x1c4a, //   adds r2, r1, #1
            0x3801, //   subs r0, #1
            0xd1fb, //   bne l
        ],
        instructions: 1 + 40 * 4,
        cycles: &[
            (M0plus, &[1 + 40 * (2 + 1 + 1) + 39 * 2 + 1; 2]),
            (
                M4,
                &[
                    1 + 40 * (2 + 1 + 1) + 39 * 3 + 1,
                    1 + 40 * (2 + 1 + 1) + 39 * 2 + 1,
                    1 + 40 * (2 + 1 + 1) + 39 * 4 + 1,
                ],
            ),
            (M33, &[1 + 40 * (2 + 1 + 1) + 39 * 2; 3]),
        ],
    },
    Loop {
        name: "branch behind MOV",
        code: &[
            0x2614, //   movs r6, #20
            0x4680, // l: mov r8, r0
            0xe000, //   b m
            0xbf00, //   nop
            0x3e01, // m: subs r6, #1
            0xd1fa, //   bne l
        ],
        instructions: 1 + 20 * 4,
        cycles: &[
            (M0plus, &[1 + 20 * (1 + 2 + 1) + 19 * 2 + 1; 2]),
            (
                M4,
                &[
                    1 + 20 * (1 + 3 + 1) + 19 * 3 + 1,
                    1 + 20 * (1 + 2 + 1) + 19 * 2 + 1,
                    1 + 20 * (1 + 4 + 1) + 19 * 4 + 1,
                ],
            ),
            (M33, &[1 + 20 * (1 + 1 + 1) + 19 * 2; 3]),
        ],
    },
    Loop {
        name: "divide, multiply, store",
        code: &[
            0x200a, //   movs r0, #10
            0xfbb2, 0xf1f0, // l: udiv r1, r2, r0
            0xfba1, 0x2300, //   umull r2, r3, r1, r0
            0xe9c5, 0x2300, //   strd r2, r3, [r5]
            0x51aa, //   str r2, [r5, r6]
            0x3801, //   subs r0, #1
            0xd1f6, //   bne l
        ],
        instructions: 1 + 10 * 6,
        cycles: &[
            (
                M4,
                &[
                    1 + 10 * (3 + 1 + 3 + 2 + 1) + 9 * 3 + 1,
                    1 + 10 * (2 + 1 + 3 + 2 + 1) + 9 * 2 + 1,
                    1 + 10 * (12 + 1 + 3 + 2 + 1) + 9 * 4 + 1,
                ],
            ),
            (
                M33,
                &[
                    1 + 10 * (4 + 1 + 2 + 1 + 1) + 9 * 2,
                    1 + 10 * (2 + 1 + 2 + 1 + 1) + 9 * 2,
                    1 + 10 * (11 + 1 + 2 + 1 + 1) + 9 * 2,
                ],
            ),
        ],
    },
    Loop {
        name: "shifted operand and use",
        code: &[
            0x2028, //   movs r0, #40
            0xeb02, 0x0183, // l: add.w r1, r2, r3, lsl #2
            0x1c4a, //   adds r2, r1, #1
            0x3801, //   subs r0, #1
            0xd1fa, //   bne l
        ],
        instructions: 1 + 40 * 4,
        cycles: &[
            (M4, &[1 + 40 * 3 + 39 * 3 + 1, 1 + 40 * 3 + 39 * 2 + 1, 1 + 40 * 3 + 39 * 4 + 1]),
            (
                M33,
                &[
                    1 + 40 * (2 + 1 + 1) + 39 * 2,
                    1 + 40 * (1 + 1 + 1) + 39 * 2,
                    1 + 40 * (2 + 1 + 1) + 39 * 2,
                ],
            ),
        ],
    },
    Loop {
        name: "IT",
        code: &[
            0x201e, //   movs r0, #30
            0x4680, // l: mov r8, r0
            0xbf08, //   it eq
            0x4611, //   moveq r1, r2
            0x3801, //   subs r0, #1
            0xd1fa, //   bne l
        ],
        instructions: 1 + 30 * 5,
        cycles: &[
            (
                M4,
                &[
                    1 + 30 * 4 + 29 * 3 + 1,
                    // IT hides behind MOV.
                    1 + 30 * 3 + 29 * 2 + 1,
                    1 + 30 * 4 + 29 * 4 + 1,
                ],
            ),
            (M33, &[1 + 30 * 3 + 29 * 2; 3]),
        ],
    },
    Loop {
        name: "FPU",
        code: &[
            0xf64e, 0x5088, //   movw r0, #0xed88
            0xf2ce, 0x0000, //   movt r0, #0xe000
            0x6803, //   ldr r3, [r0]
            0xf443, 0x0370, //   orr r3, r3, #0xf00000
            0x6003, //   str r3, [r0]
            0xf3bf, 0x8f4f, //   dsb sy
            0xf3bf, 0x8f6f, //   isb sy
            0x2014, //   movs r0, #20
            0xed94, 0x0a00, // l: vldr s0, [r4]
            0xee70, 0x0a00, //   vadd.f32 s1, s0, s0
            0xee20, 0x1aa0, //   vmul.f32 s2, s1, s1
            0xee40, 0x1a80, //   vmla.f32 s3, s1, s0
            0xee81, 0x2a00, //   vdiv.f32 s4, s2, s0
            0xed85, 0x2a00, //   vstr s4, [r5]
            0x3801, //   subs r0, #1
            0xd1f1, //   bne l
        ],
        instructions: 8 + 20 * 8,
        cycles: &[(
            M4,
            &[
                10 + 20 * (2 + 1 + 2 + 3 + 14 + 3 + 1) + 19 * 3 + 1,
                10 + 20 * (1 + 1 + 2 + 3 + 1 + 2 + 1) + 19 * 2 + 1,
                10 + 20 * (2 + 1 + 2 + 3 + 14 + 3 + 1) + 19 * 4 + 1,
            ],
        )],
    },
];
