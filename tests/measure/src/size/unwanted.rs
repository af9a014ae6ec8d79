//! Code that no scene may bring: by the names of its symbols.
//!
//! The release profile keeps all symbols, and routines of the compiler and of `core` that are
//! called are never without one, so that what is not found is not there. What was inlined into its
//! callers alone leaves no name; the routines in question are too large for that, or marked as
//! never to be inlined.

use std::fmt;

/// A kind of code that is out of place on a microcontroller without FPU.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Unwanted {
    /// Arithmetic of `f32` and `f64` by routines.
    SoftFloat,
    /// Division of 64-bit and 128-bit numbers.
    LongDivision,
    /// Formatting of text.
    Formatting,
    /// What a panic calls: a check that can fail at run time.
    Panic,
}

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
    /// What the symbol of this name is, if it is unwanted.
    ///
    /// The names of routines are those of the run-time ABI for the Arm architecture (IHI 0043,
    /// tables 2 to 8) and of libgcc, the others those of paths in the sources.
    pub(crate) fn of(name: &str) -> Option<Self> {
        // The type arguments of a function say nothing about what it does.
        let path = name.split("::<").next().unwrap_or(name);
        let is_in = |modules: &[&str]| modules.iter().any(|module| path.contains(module));
        if is_float_routine(path) || is_in(&["compiler_builtins::float::", "micromath::"]) {
            Some(Self::SoftFloat)
        } else if is_long_division(path) {
            Some(Self::LongDivision)
        } else if is_in(&["core::fmt::"]) {
            Some(Self::Formatting)
        } else if is_panic(path) {
            Some(Self::Panic)
        } else {
            None
        }
    }
}

fn is_float_routine(name: &str) -> bool {
    let Some(routine) = name.strip_prefix("__") else {
        return false;
    };
    if let Some(routine) = routine.strip_prefix("aeabi_") {
        let floats = ["f", "d", "cf", "cd", "i2", "ui2", "l2", "ul2", "h2"];
        return floats.iter().any(|prefix| routine.starts_with(prefix));
    }
    // libgcc: operation, mode (sf, df; hf and tf too), and how many modes it names.
    let stems = [
        "add", "sub", "mul", "div", "neg", "cmp", "unord", "eq", "ne", "lt", "le", "gt", "ge",
        "pow", "fix", "fixuns", "float", "floatun", "floatuns", "extend", "trunc",
    ];
    stems.iter().any(|stem| {
        let rest = routine.strip_prefix(stem);
        rest.is_some_and(|rest| {
            ["sf", "df", "hf", "tf", "xf"].iter().any(|mode| rest.contains(mode))
        })
    })
}

fn is_long_division(path: &str) -> bool {
    let routine = path.rsplit("::").next().unwrap_or(path);
    let is_of_the_abi = ["__aeabi_ldivmod", "__aeabi_uldivmod"].contains(&routine);
    // libgcc: operation and mode, `di` for 64 bits and `ti` for 128.
    let stems = ["__div", "__udiv", "__mod", "__umod", "__divmod", "__udivmod"];
    let is_of_libgcc = stems.iter().any(|stem| {
        let mode = routine.strip_prefix(stem);
        mode.is_some_and(|mode| ["di3", "ti3", "di4", "ti4"].contains(&mode))
    });
    is_of_the_abi
        || is_of_libgcc
        || (routine.ends_with("_div_rem") && (routine.contains("64") || routine.contains("128")))
}

fn is_panic(path: &str) -> bool {
    let says_so =
        |part: &str| part.contains("panic") || part.ends_with("_fail") || part.ends_with("_failed");
    path == "rust_begin_unwind" || path.split("::").any(says_so)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn routines_for_floats_are_found_by_both_kinds_of_names() {
        for name in [
            "__aeabi_fadd",
            "__aeabi_dmul",
            "__aeabi_cfcmple",
            "__aeabi_ui2f",
            "__aeabi_ul2d",
            "__aeabi_f2iz",
            "__aeabi_d2f",
            "__addsf3",
            "__muldf3",
            "__fixunssfdi",
            "__floatundisf",
            "__ltsf2",
            "__extendsfdf2",
            "compiler_builtins::float::add::__addsf3",
            "micromath::float::floor::<impl micromath::float::F32>::floor",
            "<micromath::float::F32>::sqrt",
        ] {
            assert_eq!(Unwanted::of(name), Some(Unwanted::SoftFloat), "{name}");
        }
    }

    #[test]
    fn long_divisions_are_told_from_short_ones() {
        for name in [
            "__aeabi_uldivmod",
            "__aeabi_ldivmod",
            "__udivdi3",
            "compiler_builtins::int::sdiv::__divmoddi4",
            "compiler_builtins::int::specialized_div_rem::u64_div_rem",
        ] {
            assert_eq!(Unwanted::of(name), Some(Unwanted::LongDivision), "{name}");
        }
        for name in [
            "__aeabi_uidiv",
            "__aeabi_idivmod",
            "__udivsi3",
            "compiler_builtins::int::specialized_div_rem::u32_div_rem",
        ] {
            assert_eq!(Unwanted::of(name), None, "{name}");
        }
    }

    #[test]
    fn formatting_and_panics_are_found() {
        for name in [
            "core::fmt::write",
            "<core::fmt::Formatter>::pad",
            "<u32 as core::fmt::Display>::fmt",
            "<rasterizer::scene::error::ProjectError as core::fmt::Debug>::fmt",
        ] {
            assert_eq!(Unwanted::of(name), Some(Unwanted::Formatting), "{name}");
        }
        for name in [
            "core::panicking::panic_fmt",
            "core::panicking::panic_const::panic_const_div_by_zero",
            "core::option::unwrap_failed",
            "core::option::expect_failed",
            "core::slice::index::slice_end_index_len_fail",
            "core::slice::index::slice_index_fail::do_panic::runtime",
            "core::cell::panic_already_borrowed",
            "<[u8]>::copy_from_slice_impl::len_mismatch_fail",
            "rust_begin_unwind",
        ] {
            assert_eq!(Unwanted::of(name), Some(Unwanted::Panic), "{name}");
        }
    }

    #[test]
    fn what_every_firmware_has_is_not_unwanted() {
        for name in [
            "Reset",
            "main",
            "__aeabi_memcpy",
            "__aeabi_memclr8",
            "__aeabi_lmul",
            "__aeabi_llsl",
            "__muldi3",
            "__clzsi2",
            "__ashldi3",
            "compiler_builtins::int::mul::__muldi3",
            "compiler_builtins::mem::memset",
            "<rasterizer::numbers::float::Float>::times",
            "rasterizer::geometry::clip::crossing::<[u16; 0]>",
            // A type argument names it, the function is another.
            "firmware::sizes::run::<core::fmt::Error>",
            "<rasterizer::mesh::Mesh>::failsafe",
        ] {
            assert_eq!(Unwanted::of(name), None, "{name}");
        }
    }
}
