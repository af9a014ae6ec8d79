//! Code that no scene may bring, found by the names of its symbols.
//!
//! The firmware's profile keeps all symbols, and every routine of the compiler and of `core` that
//! is called has one: if the symbol is absent, the code was not linked. A function that is inlined
//! into all its callers leaves no symbol; these routines are too large for that, or marked as never
//! to be inlined.

use std::{fmt, sync::LazyLock};

use regex_lite::Regex;

/// A kind of code that is out of place on a microcontroller without FPU.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Unwanted {
    /// Arithmetic of `f32` and `f64` by routines.
    SoftFloat,
    /// Division of 64-bit and 128-bit numbers.
    LongDivision,
    /// Formatting of text.
    Formatting,
    /// Calls of a panic: checks that can fail at run time.
    Panic,
}

/// Patterns of names. Routines have the names of the run-time ABI for the Arm architecture (IHI
/// 0043, tables 2 to 8) or of libgcc (operation, then modes: `sf` for `f32`, `di` for `i64`, `ti`
/// for `i128`, and so on), other functions those of paths in the sources.
const PATTERNS: [(Unwanted, &str); 4] = [
    (
        Unwanted::SoftFloat,
        "^__aeabi_(f|d|cf|cd|i2|ui2|l2|ul2|h2)|\
         ^__(add|sub|mul|div|neg|cmp|unord|eq|ne|lt|le|gt|ge|pow|fix|float|extend|trunc).*[sdhtx]f|\
         compiler_builtins::float::|micromath::",
    ),
    (
        Unwanted::LongDivision,
        "(^|::)(__aeabi_u?ldivmod|__u?(div|mod|divmod)[dt]i[34]|[^:]*(64|128)[^:]*_div_rem)$",
    ),
    (Unwanted::Formatting, "core::fmt::"),
    (Unwanted::Panic, "panic|_fail(ed)?(::|$)|^rust_begin_unwind$"),
];

static REGEXES: LazyLock<Vec<(Unwanted, Regex)>> = LazyLock::new(|| {
    let compiled = PATTERNS.iter().map(|(kind, text)| Some((*kind, Regex::new(text).ok()?)));
    compiled.collect::<Option<_>>().expect("the patterns are regular expressions")
});

impl fmt::Display for Unwanted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::SoftFloat => "floating point",
            Self::LongDivision => "64-bit division",
            Self::Formatting => "formatting",
            Self::Panic => "panics",
        })
    }
}

impl Unwanted {
    /// The kind of the symbol with this name, if it is unwanted.
    pub(crate) fn of(name: &str) -> Option<Self> {
        // The type arguments of a function do not matter.
        let path = name.split("::<").next().unwrap_or(name);
        REGEXES.iter().find(|(_, regex)| regex.is_match(path)).map(|(kind, _)| *kind)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_all(names: &str, expected: Option<Unwanted>) {
        for name in names.split(", ") {
            assert_eq!(Unwanted::of(name), expected, "{name}");
        }
    }

    #[test]
    fn routines_for_floats_are_found_by_both_kinds_of_names() {
        assert_all(
            "__aeabi_fadd, __aeabi_dmul, __aeabi_cfcmple, __aeabi_ui2f, __aeabi_ul2d, \
             __aeabi_f2iz, __aeabi_d2f, __addsf3, __muldf3, __fixunssfdi, __floatundisf, \
             __ltsf2, __extendsfdf2, compiler_builtins::float::add::__addsf3, \
             micromath::float::floor::<impl micromath::float::F32>::floor, \
             <micromath::float::F32>::sqrt",
            Some(Unwanted::SoftFloat),
        );
    }

    #[test]
    fn long_divisions_are_told_from_short_ones() {
        assert_all(
            "__aeabi_uldivmod, __aeabi_ldivmod, __udivdi3, \
             compiler_builtins::int::sdiv::__divmoddi4, \
             compiler_builtins::int::specialized_div_rem::u64_div_rem",
            Some(Unwanted::LongDivision),
        );
        assert_all(
            "__aeabi_uidiv, __aeabi_idivmod, __udivsi3, \
             compiler_builtins::int::specialized_div_rem::u32_div_rem",
            None,
        );
    }

    #[test]
    fn formatting_and_panics_are_found() {
        assert_all(
            "core::fmt::write, <core::fmt::Formatter>::pad, <u32 as core::fmt::Display>::fmt, \
             <rasterizer::scene::error::ProjectError as core::fmt::Debug>::fmt",
            Some(Unwanted::Formatting),
        );
        assert_all(
            "core::panicking::panic_fmt, core::panicking::panic_const::panic_const_div_by_zero, \
             core::option::unwrap_failed, core::option::expect_failed, rust_begin_unwind, \
             core::slice::index::slice_end_index_len_fail, core::cell::panic_already_borrowed, \
             core::slice::index::slice_index_fail::do_panic::runtime, \
             <[u8]>::copy_from_slice_impl::len_mismatch_fail",
            Some(Unwanted::Panic),
        );
    }

    #[test]
    fn code_that_every_firmware_has_is_not_unwanted() {
        // A type argument of the last but one names it, the function is another.
        assert_all(
            "Reset, main, __aeabi_memcpy, __aeabi_memclr8, __aeabi_lmul, __aeabi_llsl, __muldi3, \
             __clzsi2, __ashldi3, compiler_builtins::int::mul::__muldi3, \
             compiler_builtins::mem::memset, <rasterizer::numbers::float::Float>::times, \
             rasterizer::geometry::clip::crossing::<[u16; 0]>, \
             firmware::sizes::run::<core::fmt::Error>, <rasterizer::mesh::Mesh>::failsafe",
            None,
        );
    }
}
