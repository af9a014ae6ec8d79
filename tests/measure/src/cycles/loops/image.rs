//! Raw images of loops, with marks around them.

use std::{ffi::OsString, path::Path};

use crate::{cores::Core, qemu};

/// A raw image, to be loaded at the address that its core starts from.
pub(super) struct Image {
    pub(super) bytes: Vec<u8>,
    /// The address of its marks.
    pub(super) marks: u32,
}

/// Where a core's image and its RAM begin.
const fn memory(core: Core) -> [u32; 2] {
    match core {
        Core::M33 => [0x1000_0000, 0x3800_0000],
        Core::Riscv => [0x8000_0000, 0x8001_0000],
        _ => [0, 0x2000_0000],
    }
}

/// The arguments of QEMU that load an image.
pub(super) fn loaded_by(core: Core, path: &Path) -> [OsString; 2] {
    let (path, start) = (qemu::quoted(path), memory(core)[0]);
    let loader = format!("loader,file={path},addr={start:#x},force-raw=on");
    ["-device".into(), loader.into()]
}

/// An image that runs code in the first stage's window, reports, and ends QEMU.
pub(super) fn of(core: Core, code: &[u16]) -> Image {
    if core == Core::Riscv { riscv(core, code) } else { thumb(core, code) }
}

/// R4 and R5 point to memory, R1 is 3, R2 is 9, R6 is 0. R7 points to the marks and must stay.
fn thumb(core: Core, code: &[u16]) -> Image {
    let [start, ram] = memory(core);
    let (marks, stack) = (ram + 0x3000, ram + 0x8000);
    // 16 vectors; all but the first go to the code behind them.
    let mut words = vec![start + 64 + 1; 16];
    words[0] = stack;
    let mut halfwords = vec![
        0x4f03, // ldr r7, [pc, #12]
        0x4c04, // ldr r4, [pc, #16]
        0x4d04, // ldr r5, [pc, #16]
        0x2600, // movs r6, #0
        0x2209, // movs r2, #9
        0x2103, // movs r1, #3
        0xe006, // b, over the literals
        0xbf00, // nop
    ];
    for literal in [marks, ram + 0x1000, ram + 0x2000] {
        halfwords.extend([literal as u16, (literal >> 16) as u16]);
    }
    halfwords.push(0x6038); // str r0, [r7]: opens the window
    halfwords.extend(code);
    halfwords.extend([
        0x6038, // str r0, [r7]: closes it
        0x60f8, // str r0, [r7, #12]: reports
        0x2018, // movs r0, #0x18: exit
        0x2102, // movs r1, #2
        0x0409, // lsls r1, r1, #16
        0x3126, // adds r1, #0x26: well
        0xbeab, // bkpt #0xab
        0xe7fe, // b, to itself
    ]);
    Image { bytes: bytes(&words, &halfwords), marks }
}

/// A1 points to memory. T0 points to the marks and must stay. The code begins at a word.
fn riscv(core: Core, code: &[u16]) -> Image {
    let before = [
        0x8001_02b7, // lui t0, 0x80010: the marks, where RAM begins
        0x8001_15b7, // lui a1, 0x80011
        0x0002_a023, // sw zero, 0(t0): opens the window
    ];
    let behind: [u16; 17] = [
        0xa023, 0x0002, // sw zero, 0(t0): closes it
        0xa623, 0x0002, // sw zero, 12(t0): reports
        0x4561, // li a0, 0x18: exit
        0x05b7, 0x0002, // lui a1, 0x20
        0x8593, 0x0265, // addi a1, a1, 0x26: well
        0x1013, 0x01f0, // slli zero, zero, 31
        0x0073, 0x0010, // ebreak
        0x5013, 0x4070, // srai zero, zero, 7
        0xa001, // j, to itself
        0x0000,
    ];
    let halfwords: Vec<_> = code.iter().chain(&behind).copied().collect();
    Image { bytes: bytes(&before, &halfwords), marks: memory(core)[1] }
}

fn bytes(words: &[u32], halfwords: &[u16]) -> Vec<u8> {
    let words = words.iter().flat_map(|word| word.to_le_bytes());
    words.chain(halfwords.iter().flat_map(|halfword| halfword.to_le_bytes())).collect()
}
