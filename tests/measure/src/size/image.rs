//! The flash and static RAM of a program, from its ELF file.

use std::{collections::BTreeMap, ops::Range};

use anyhow::{Context as _, Result, ensure};
use object::{
    File, Object as _, ObjectSection as _, ObjectSymbol as _, Section, SectionFlags, SectionIndex,
    SectionKind,
    elf::{SHF_ALLOC, SHF_WRITE},
};
use rustc_demangle::demangle;

/// The tables of models are the statics of this module of the firmware.
const MODELS: &str = "firmware::models::";

/// Where the stack begins on RISC-V, whose programs have no vector table.
const STACK_TOP: &str = "_stack_start";

/// A program as it is linked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Image {
    /// Bytes of flash: all sections that are loaded, the image of initialised statics included.
    pub(crate) flash: u32,
    /// How many of them are tables of models.
    pub(crate) models: u32,
    /// The addresses of the statics, which lie at the beginning of RAM.
    pub(crate) statics: Range<u32>,
    /// Where the stack begins, to grow downwards: the end of RAM.
    pub(crate) stack_top: u32,
    /// All functions and statics, the largest first.
    pub(crate) symbols: Vec<Symbol>,
}

/// A function or a static.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Symbol {
    /// The name as it was written in its source.
    pub(crate) name: String,
    pub(crate) address: u32,
    /// In bytes.
    pub(crate) size: u32,
    pub(crate) is_in_flash: bool,
}

impl Symbol {
    /// Whether it is a table of a model.
    pub(crate) fn is_of_a_model(&self) -> bool {
        self.is_in_flash && self.name.starts_with(MODELS)
    }
}

impl Image {
    /// Reads an ELF file.
    ///
    /// The size of a model is the sum of the sizes of its tables' symbols, which is exactly the
    /// part of it that was linked. Bytes that two symbols name count once.
    ///
    /// # Errors
    ///
    /// Returns an error if the file is no ELF file, has no symbols, or neither a vector table nor
    /// the top of a stack.
    pub(crate) fn parse(file: &[u8]) -> Result<Self> {
        let file = File::parse(file).context("the program is no ELF file")?;
        let (mut flash, mut statics) = (0, None::<Range<u32>>);
        for section in file.sections() {
            if !is_flagged(&section, SHF_ALLOC) {
                continue;
            }
            let (start, size) = (section.address() as u32, section.size() as u32);
            if section.kind() != SectionKind::UninitializedData {
                flash += size;
            }
            // The runtime of RISC-V has a section for the stack.
            let is_stack = section.name() == Ok(".stack");
            if is_flagged(&section, SHF_WRITE) && size > 0 && !is_stack {
                let before = statics.unwrap_or(start..start);
                statics = Some(before.start.min(start)..before.end.max(start + size));
            }
        }
        let symbols = symbols(&file);
        let vectors = file.section_by_name(".vector_table");
        let vectors = vectors.and_then(|section| section.data().ok()?.first_chunk::<4>().copied());
        let named = symbols.iter().find(|symbol| symbol.name == STACK_TOP);
        let stack_top = (vectors.map(u32::from_le_bytes))
            .or_else(|| named.map(|symbol| symbol.address))
            .context("the program has no vector table and no stack")?;
        let tables = symbols.iter().filter(|symbol| symbol.is_of_a_model());
        let tables: BTreeMap<_, _> = tables.map(|table| (table.address, table.size)).collect();
        ensure!(!symbols.is_empty(), "the program has no symbols: its profile must not strip them");
        Ok(Self {
            flash,
            models: tables.values().sum(),
            statics: statics.unwrap_or_default(),
            stack_top,
            symbols,
        })
    }

    /// Bytes of flash without the tables of models.
    pub(crate) const fn code(&self) -> u32 {
        self.flash - self.models
    }

    /// Bytes of statics.
    pub(crate) const fn static_bytes(&self) -> u32 {
        self.statics.end - self.statics.start
    }

    /// The address of the static or function with this name. An error if there is none.
    pub(crate) fn address_of(&self, name: &str) -> Result<u32> {
        let symbol = self.symbols.iter().find(|symbol| symbol.name == name);
        Ok(symbol.with_context(|| format!("the program has no symbol {name}"))?.address)
    }
}

fn is_flagged(section: &Section<'_, '_>, flag: u32) -> bool {
    matches!(section.flags(), SectionFlags::Elf { sh_flags } if sh_flags & u64::from(flag) != 0)
}

/// The functions and statics of a program, the largest first.
pub(crate) fn symbols(file: &File<'_>) -> Vec<Symbol> {
    let is_in_ram = |index: SectionIndex| {
        let section = file.section_by_index(index).ok();
        section.is_some_and(|section| is_flagged(&section, SHF_WRITE))
    };
    let mut symbols: Vec<_> = file
        .symbols()
        .filter_map(|symbol| {
            // Those that begin with a dollar sign mark code and data for disassemblers.
            let name =
                symbol.name().ok().filter(|name| !name.is_empty() && !name.starts_with('$'))?;
            Some(Symbol {
                name: format!("{:#}", demangle(name)),
                address: symbol.address() as u32,
                size: symbol.size() as u32,
                is_in_flash: !symbol.section_index().is_some_and(is_in_ram),
            })
        })
        .collect();
    symbols.sort_by(|a, b| (b.size, &a.name).cmp(&(a.size, &b.name)));
    symbols
}

#[cfg(test)]
mod tests {
    use object::{
        Architecture, BinaryFormat, Endianness, SymbolFlags, SymbolKind, SymbolScope,
        write::{Object, SectionId, StandardSection, Symbol as NewSymbol, SymbolSection},
    };

    use super::*;

    fn add(object: &mut Object<'_>, section: SectionId, name: &str, value: u64, size: u64) {
        object.add_symbol(NewSymbol {
            name: name.into(),
            value,
            size,
            kind: SymbolKind::Data,
            scope: SymbolScope::Compilation,
            weak: false,
            section: SymbolSection::Section(section),
            flags: SymbolFlags::None,
        });
    }

    fn object() -> Object<'static> {
        let mut object = Object::new(BinaryFormat::Elf, Architecture::Arm, Endianness::Little);
        let vectors =
            object.add_section(vec![], b".vector_table".to_vec(), SectionKind::ReadOnlyData);
        object.append_section_data(vectors, &[0x00, 0x20, 0x04, 0x20, 0xC1, 0, 0, 0], 4);
        object
    }

    /// A program of 8 bytes of vectors, 20 of code, 30 of constants, 4 of initialised statics and
    /// 64 of others.
    fn program() -> Vec<u8> {
        let mut object = object();
        let text = object.section_id(StandardSection::Text);
        object.append_section_data(text, &[0; 20], 4);
        let constants = object.section_id(StandardSection::ReadOnlyData);
        object.append_section_data(constants, &[0; 30], 2);
        let data = object.section_id(StandardSection::Data);
        object.append_section_data(data, &[1; 4], 4);
        let bss = object.section_id(StandardSection::UninitializedData);
        object.append_section_bss(bss, 64, 4);
        let notes = object.add_section(vec![], b".debug_info".to_vec(), SectionKind::Debug);
        object.append_section_data(notes, &[0; 100], 1);
        add(&mut object, text, "_ZN4core3fmt5write17h0123456789abcdefE", 0, 20);
        add(&mut object, text, "$t", 0, 0);
        let table = "_ZN8firmware6models4CUBE9POSITIONS17h0123456789abcdefE";
        add(&mut object, constants, table, 4, 18);
        add(&mut object, constants, "_ZN8firmware6models4CUBE5ALIAS17h0123456789abcdefE", 4, 18);
        add(&mut object, constants, "_ZN8firmware6models4CUBE17h0123456789abcdefE", 22, 6);
        add(&mut object, bss, "BUFFER", 0, 64);
        object.write().unwrap()
    }

    #[test]
    fn loaded_sections_are_flash_and_writable_ones_statics() {
        let image = Image::parse(&program()).unwrap();
        assert_eq!(image.flash, 8 + 20 + 30 + 4);
        assert_eq!(image.static_bytes(), 64, "an object file has all sections at address 0");
        assert_eq!(image.stack_top, 0x2004_2000);
    }

    #[test]
    fn tables_of_models_are_no_code_and_count_once() {
        let image = Image::parse(&program()).unwrap();
        assert_eq!(image.models, 18 + 6);
        assert_eq!(image.code(), 62 - 24);
    }

    #[test]
    fn symbols_are_named_as_in_the_source_and_the_largest_comes_first() {
        let image = Image::parse(&program()).unwrap();
        let names: Vec<_> = image.symbols.iter().map(|symbol| symbol.name.as_str()).collect();
        assert_eq!(names[0], "BUFFER");
        let in_flash = image.symbols.iter().filter(|symbol| symbol.is_in_flash);
        assert_eq!(in_flash.count(), names.len() - 1, "the buffer alone lies in RAM");
        assert!(names.contains(&"core::fmt::write"), "{names:?}");
        assert!(!names.contains(&"$t"));
        assert_eq!(image.address_of("firmware::models::CUBE").unwrap(), 22);
        assert!(image.address_of("firmware::models::SPHERE").is_err());
    }

    #[test]
    fn what_cannot_be_measured_is_refused() {
        assert!(Image::parse(b"no ELF file").is_err());
        let stripped = object().write().unwrap();
        let fault = Image::parse(&stripped).unwrap_err().to_string();
        assert!(fault.contains("no symbols"), "{fault}");
        let bare = Object::new(BinaryFormat::Elf, Architecture::Arm, Endianness::Little);
        let fault = Image::parse(&bare.write().unwrap()).unwrap_err().to_string();
        assert!(fault.contains("no vector table"), "{fault}");
    }

    #[test]
    fn a_stack_with_a_section_is_no_static() {
        let mut object = Object::new(BinaryFormat::Elf, Architecture::Riscv32, Endianness::Little);
        let bss = object.section_id(StandardSection::UninitializedData);
        object.append_section_bss(bss, 64, 4);
        let stack = object.add_section(vec![], b".stack".to_vec(), SectionKind::UninitializedData);
        object.append_section_bss(stack, 4096, 4);
        add(&mut object, stack, "_stack_start", 4096, 0);
        let image = Image::parse(&object.write().unwrap()).unwrap();
        assert_eq!((image.static_bytes(), image.stack_top), (64, 4096));
    }
}
