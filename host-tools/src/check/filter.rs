//! Which colours a pixel of a texture may have, from the exact coordinate and how far the core's
//! may be off.
//!
//! Close to the border of a texel, either texel is right; everywhere else only one is. A filtered
//! colour changes evenly with the coordinate, so the colours that it may have are those between the
//! ones at the corners of the rectangle of coordinates, and at the texels' centres within it.
//!
//! The level of detail is that of a pixel's area in texels, which the core documents.

use crate::reference::{Footprint, Mipmaps, Texel, Wrap, is_opaque};

/// How a pixel's colour is taken from a texture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Filter {
    /// The texel at the pixel's centre.
    #[default]
    Nearest,
    /// The four texels around it, linear between them.
    Bilinear,
    /// The texel in the nearest mip level.
    Mipmap,
    /// Bilinear in two mip levels, linear between them.
    Trilinear,
}

impl Filter {
    /// All of them, each with its name on the command line.
    pub const NAMES: [(&'static str, Self); 4] = [
        ("nearest", Self::Nearest),
        ("bilinear", Self::Bilinear),
        ("mipmap", Self::Mipmap),
        ("trilinear", Self::Trilinear),
    ];

    /// The exact colour of a pixel.
    #[must_use]
    pub fn texel(self, texture: &Mipmaps, exact: &Footprint) -> Texel {
        let level = || exact.level_by_area(texture.base().size());
        match self {
            Self::Nearest => texture.base().nearest(exact.uv),
            Self::Bilinear => texture.base().bilinear(exact.uv),
            Self::Mipmap => texture.nearest(exact.uv, level()),
            Self::Trilinear => texture.trilinear(exact.uv, level()),
        }
    }

    /// Whether it reads mip levels.
    #[must_use]
    pub const fn reads_levels(self) -> bool {
        matches!(self, Self::Mipmap | Self::Trilinear)
    }
}

/// By how much a level of detail may be off.
const LEVEL: f64 = 0.25;

/// What the core rounds while it mixes texels and light, by its colour type.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Precision {
    /// The binary digits of a weight's fraction. It is rounded to the nearest, which is as if the
    /// coordinate were half a unit off.
    pub fraction_bits: u32,
    /// Of the four weights that a product has half a unit of 32 too much or too little: one has it,
    /// and its neighbours have it the other way round.
    pub short_weights: bool,
    /// The steps of light from dark to full; a level is rounded to the nearest.
    pub light_steps: u32,
}

impl Precision {
    /// Of colours that are mixed channel by channel in 8 bits.
    pub const OF_CHANNELS: Self = Self { fraction_bits: 8, short_weights: false, light_steps: 256 };
    /// Of colours of 16 bits, which are mixed in one word.
    pub const OF_WORDS: Self = Self { fraction_bits: 4, short_weights: true, light_steps: 32 };
}

/// Colours between two, channel by channel: the red, green and blue of texels.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Range {
    low: [f64; 3],
    high: [f64; 3],
}

impl Range {
    const fn of([red, green, blue, _]: Texel) -> Self {
        Self { low: [red, green, blue], high: [red, green, blue] }
    }

    fn with(self, other: Self) -> Self {
        Self {
            low: std::array::from_fn(|i| self.low[i].min(other.low[i])),
            high: std::array::from_fn(|i| self.high[i].max(other.high[i])),
        }
    }

    /// From this to another, at the fraction `t` of the way.
    fn toward(self, other: Self, t: f64) -> Self {
        let blend = |a: f64, b: f64| a + t * (b - a);
        Self {
            low: std::array::from_fn(|i| blend(self.low[i], other.low[i])),
            high: std::array::from_fn(|i| blend(self.high[i], other.high[i])),
        }
    }

    fn widened(self, by: [f64; 3]) -> Self {
        Self {
            low: std::array::from_fn(|i| self.low[i] - by[i]),
            high: std::array::from_fn(|i| self.high[i] + by[i]),
        }
    }

    fn lit(self, [low, high]: [f64; 2]) -> Self {
        Self { low: self.low.map(|c| c * low), high: self.high.map(|c| c * high) }
    }

    /// The colour in it that is closest to another, and the largest difference of a channel.
    fn closest(self, color: [f64; 3]) -> (f64, [f64; 3]) {
        let closest = std::array::from_fn(|i| color[i].clamp(self.low[i], self.high[i]));
        let off = |i: usize| (closest[i] - color[i]).abs();
        (off(0).max(off(1)).max(off(2)), closest)
    }
}

/// The texture at a pixel, with all that may be off.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a> {
    /// The texture.
    pub texture: &'a Mipmaps,
    /// The exact coordinate and its derivatives.
    pub exact: Footprint,
    /// How far u and v may be off, in texels of the largest level.
    pub bounds: [f64; 2],
    /// The level of detail that is meant: it may be a quarter off.
    pub level: f64,
    /// The light level, from 0 to 1.
    pub light: f64,
}

/// What is right at a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Right {
    /// The right colour that is closest to the one drawn; `None` if the pixel must be transparent.
    pub color: Option<[f64; 3]>,
    /// Whether it may be transparent.
    pub may_be_transparent: bool,
}

impl Seen<'_> {
    /// What is right, by a filter, where the core has drawn `drawn`.
    #[must_use]
    pub fn right(&self, filter: Filter, precision: Precision, drawn: [f64; 3]) -> Right {
        let mut found =
            Found { drawn, light: self.light(precision), best: None, transparent: false };
        let [least, most] = self.levels();
        let last = self.texture.levels().len() - 1;
        match filter {
            Filter::Nearest => self.nearest(0, &mut found),
            Filter::Bilinear => {
                self.for_each_base(0, &mut found, |base| Some(self.bilinear(0, base, precision)));
            }
            Filter::Mipmap => {
                let nearest = |level: f64| self.texture.nearest_level(level);
                (nearest(least)..=nearest(most)).for_each(|level| self.nearest(level, &mut found));
            }
            Filter::Trilinear => {
                let levels = [least, most].map(|level| self.texture.clamp(level));
                // Linear between whole levels: the ends, and the whole levels between them.
                let whole =
                    (levels[0].ceil() as usize..=levels[1].floor() as usize).map(|l| l as f64);
                self.for_each_base(levels[0] as usize, &mut found, |base| {
                    levels
                        .into_iter()
                        .chain(whole.clone())
                        .map(|level| {
                            let fine = level.floor() as usize;
                            let at = |level| self.bilinear(level, base, precision);
                            at(fine).toward(at((fine + 1).min(last)), level - fine as f64)
                        })
                        .reduce(Range::with)
                });
            }
        }
        Right { color: found.best.map(|(_, color)| color), may_be_transparent: found.transparent }
    }

    /// The levels of detail that are right, which may be none that there is.
    fn levels(&self) -> [f64; 2] {
        [self.level - LEVEL, self.level + LEVEL]
    }

    /// The levels of light that are right.
    fn light(&self, precision: Precision) -> [f64; 2] {
        let half = 0.5 / f64::from(precision.light_steps);
        // Full light is exact.
        if self.light >= 1.0 { [1.0; 2] } else { [self.light - half, self.light + half] }
    }

    /// The coordinate in texels of a level, and how far it may be off there.
    fn place(&self, level: usize) -> [[f64; 2]; 2] {
        let texture = &self.texture.levels()[level];
        let (size, base) = (texture.size(), self.texture.base().size());
        let bounds = [0, 1].map(|i| self.bounds[i] * size[i] as f64 / base[i] as f64);
        [texture.in_texels(self.exact.uv), bounds]
    }

    /// The texels that the coordinate may lie on.
    fn touched(&self, level: usize) -> impl Iterator<Item = Texel> {
        let texture = &self.texture.levels()[level];
        let [place, bounds] = self.place(level);
        let [columns, rows] = [0, 1].map(|i| {
            let [low, high] = [place[i] - bounds[i], place[i] + bounds[i]];
            numbers(low, high, texture.size()[i], texture.wrap()[i])
        });
        rows.flat_map(move |row| columns.clone().map(move |column| texture.texel([column, row])))
    }

    fn nearest(&self, level: usize, found: &mut Found) {
        for texel in self.touched(level) {
            if is_opaque(texel) {
                found.add(Range::of(texel));
            } else {
                found.transparent = true;
            }
        }
    }

    /// Adds the colours that `colors` returns for each texel that may be the nearest one: it
    /// decides whether a pixel is transparent, and stands in for those that are.
    fn for_each_base(
        &self,
        level: usize,
        found: &mut Found,
        colors: impl Fn(Texel) -> Option<Range>,
    ) {
        for base in self.touched(level) {
            match is_opaque(base).then(|| colors(base)).flatten() {
                Some(range) => found.add(range),
                None => found.transparent = true,
            }
            // Where all are opaque, it doesn't matter which is the nearest.
            if self.texture.is_opaque() {
                break;
            }
        }
    }

    /// The bilinear colours of a level, with `base` in the place of transparent texels.
    fn bilinear(&self, level: usize, base: Texel, precision: Precision) -> Range {
        /// Beyond it, the texels themselves are between which the colours lie.
        const MOST: f64 = 2.0;
        let texture = &self.texture.levels()[level];
        let [place, bounds] = self.place(level);
        let half = 0.5f64.powi(precision.fraction_bits as i32 + 1);
        let ends = [0, 1].map(|i| {
            let (center, reach) = (place[i] - 0.5, bounds[i] + half);
            [center - reach, center + reach]
        });
        let texel = |place: [i64; 2]| {
            let texel = texture.texel(place);
            if is_opaque(texel) { texel } else { base }
        };
        let [columns, rows] = [0, 1].map(|i| {
            let [low, high] = ends[i];
            numbers(low, high + 1.0, texture.size()[i], texture.wrap()[i])
        });
        let all = rows.clone().flat_map(|row| columns.clone().map(move |column| [column, row]));
        let hull = |places: &mut dyn Iterator<Item = [i64; 2]>| {
            places.map(|place| Range::of(texel(place))).reduce(Range::with)
        };
        let hull = hull(&mut all.clone()).unwrap_or(Range::of(base));
        let range = if bounds[0].max(bounds[1]) > MOST {
            hull
        } else {
            // The whole numbers between the ends are centres.
            let [us, vs] = ends.map(|[low, high]| {
                let whole = (low.ceil() as i64..=high.floor() as i64).map(|n| n as f64);
                whole.chain([low, high]).collect::<Vec<_>>()
            });
            let at = |u: f64, v: f64| {
                let [column, row] = [u, v].map(|c| c.floor() as i64);
                let line = |row: i64| {
                    let [a, b] = [column, column + 1].map(|column| Range::of(texel([column, row])));
                    a.toward(b, u - u.floor())
                };
                line(row).toward(line(row + 1), v - v.floor())
            };
            let corners = us.iter().flat_map(|&u| vs.iter().map(move |&v| (u, v)));
            corners.map(|(u, v)| at(u, v)).reduce(Range::with).unwrap_or(hull)
        };
        if !precision.short_weights {
            return range;
        }
        // Half a unit of 32 for each pair of texels on a diagonal, the one more and the other less.
        let unit = std::array::from_fn(|i| (hull.high[i] - hull.low[i]) * 2.0 * 0.5 / 32.0);
        let widened = range.widened(unit);
        // No weight is negative.
        Range {
            low: std::array::from_fn(|i| widened.low[i].max(hull.low[i])),
            high: std::array::from_fn(|i| widened.high[i].min(hull.high[i])),
        }
    }
}

/// The numbers of the texels from one place to another, each that is seen there at least once.
fn numbers(low: f64, high: f64, side: usize, wrap: Wrap) -> std::ops::RangeInclusive<i64> {
    let (low, high) = (low.floor() as i64, high.floor() as i64);
    let side = side as i64;
    match wrap {
        Wrap::Clamp => low.clamp(0, side - 1)..=high.clamp(0, side - 1),
        // The side and its mirror image have all of them.
        Wrap::Repeat | Wrap::Mirror => low..=high.min(low.saturating_add(2 * side - 1)),
    }
}

/// The best of the right colours.
struct Found {
    drawn: [f64; 3],
    light: [f64; 2],
    best: Option<(f64, [f64; 3])>,
    transparent: bool,
}

impl Found {
    fn add(&mut self, range: Range) {
        let found = range.lit(self.light).closest(self.drawn);
        if self.best.is_none_or(|best| found.0 < best.0) {
            self.best = Some(found);
        }
    }
}
