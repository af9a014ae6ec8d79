//! The README's firmware is the one that is compiled, and draws a rocket.

use std::fs;

use embedded_graphics_core::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
use rasterizer::prelude::Turn;

/// A display that keeps its pixels.
struct Memory(Vec<Rgb565>);

impl OriginDimensions for Memory {
    fn size(&self) -> Size {
        Size::new(240, 240)
    }
}

impl DrawTarget for Memory {
    type Color = Rgb565;
    type Error = core::convert::Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Self::Error> {
        for Pixel(point, color) in pixels {
            self.0[(point.y * 240 + point.x) as usize] = color;
        }
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = Rgb565>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), Self::Error> {
        self.draw_iter(area.points().zip(colors).map(|(p, c)| Pixel(p, c)))
    }
}

#[test]
fn the_readme_quotes_what_is_compiled() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    let source = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/src/readme.rs")).unwrap();
    let quoted = source.split("// README\n").nth(1).unwrap();
    let readme = fs::read_to_string(format!("{root}/README.md")).unwrap();
    assert!(readme.contains(quoted), "README.md does not hold this:\n{quoted}");
}

/// The lines for a texture are those of an example, whose picture is compared by its own test.
#[test]
fn the_readme_quotes_the_example_with_a_texture() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    let read = |path| fs::read_to_string(format!("{root}/{path}")).unwrap();
    let (readme, example) = (read("README.md"), read("rasterizer/examples/textured.rs"));
    let (_, section) = readme.split_once("\n## Textures\n").unwrap();
    let (_, code) = section.split_once("```rust\n").unwrap();
    let (code, _) = code.split_once("```").unwrap();
    let module = "mod wooden_crate;";
    for line in code.lines().filter(|line| !line.is_empty()) {
        let is_there = example
            .lines()
            .any(|there| there.trim() == line.trim() || line == module && there.contains(module));
        assert!(is_there, "the example lacks this line of README.md: {line}");
    }
    assert!(code.lines().count() > 3);
}

#[test]
fn the_readmes_firmware_draws_a_rocket() {
    let mut display = Memory(vec![Rgb565::WHITE; 240 * 240]);
    let Ok(()) = firmware::readme::show(&mut display, Turn::degrees(30));
    assert!(!display.0.contains(&Rgb565::WHITE), "a band was left out");
    let drawn = display.0.iter().filter(|&&p| p != Rgb565::BLACK).count();
    assert!((4_000..20_000).contains(&drawn), "{drawn} pixels are no rocket");
    let red = display.0.iter().filter(|p| p.r() > 4 * p.g().max(1) / 2).count();
    assert!(red > 500, "only {red} red pixels");
}
