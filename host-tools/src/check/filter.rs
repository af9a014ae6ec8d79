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

/// The least alpha of a pixel that is drawn where pixels are replaced.
const HALF: f64 = 127.5;

/// By how much an alpha may be off, in steps of 8 bits: that of a texel half a unit of 256, and
/// each mix of two.
const ALPHA_ROUNDING: f64 = 1.5;

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

/// Texels between two, channel by channel: red, green, blue and alpha.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Range {
    low: Texel,
    high: Texel,
}

impl Range {
    const fn of(texel: Texel) -> Self {
        Self { low: texel, high: texel }
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

    fn widened(self, by: Texel) -> Self {
        Self {
            low: std::array::from_fn(|i| self.low[i] - by[i]),
            high: std::array::from_fn(|i| self.high[i] + by[i]),
        }
    }

    /// With the light on the colours.
    fn lit(self, [low, high]: [f64; 2]) -> Self {
        let lit = |[red, green, blue, alpha]: Texel, level: f64| {
            [red * level, green * level, blue * level, alpha]
        };
        Self { low: lit(self.low, low), high: lit(self.high, high) }
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
    /// Whether texels have the alpha that they have, which is mixed like their colours, and a
    /// pixel is drawn by the result; otherwise each is opaque or not, and the nearest one decides.
    pub is_translucent: bool,
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
        self.visit(filter, precision, &mut |range| match range {
            Some(range) if self.is_translucent => {
                // Where it is not certain on which side of half the mixed alpha lies, both are
                // right.
                let ([.., low], [.., high]) = (range.low, range.high);
                found.transparent |= low < HALF + ALPHA_ROUNDING;
                if high >= HALF - ALPHA_ROUNDING {
                    found.add(range);
                }
            }
            Some(range) => found.add(range),
            None => found.transparent = true,
        });
        Right { color: found.best.map(|(_, color)| color), may_be_transparent: found.transparent }
    }

    /// The least and the greatest alpha, from 0 to 1, that are right by a filter.
    #[must_use]
    pub fn alphas(&self, filter: Filter, precision: Precision) -> [f64; 2] {
        let mut ends = [f64::INFINITY, f64::NEG_INFINITY];
        self.visit(filter, precision, &mut |range| {
            let [low, high] = match range {
                Some(Range { low: [.., low], high: [.., high] }) if self.is_translucent => {
                    [low / 255.0, high / 255.0]
                }
                Some(_) => [1.0; 2],
                None => [0.0; 2],
            };
            ends = [ends[0].min(low), ends[1].max(high)];
        });
        // A mix is rounded to a 256th, and one of two levels again.
        let mixes = match filter {
            Filter::Nearest | Filter::Mipmap => 0.0,
            Filter::Bilinear => 1.0,
            Filter::Trilinear => 2.0,
        };
        let rounding = if self.is_translucent { mixes * 0.5 / 256.0 } else { 0.0 };
        [(ends[0] - rounding).max(0.0), (ends[1] + rounding).min(1.0)]
    }

    /// Visits what a pixel may have by a filter: a range of texels, or `None` for a transparent
    /// one.
    fn visit(&self, filter: Filter, precision: Precision, found: &mut dyn FnMut(Option<Range>)) {
        let [least, most] = self.levels();
        let last = self.texture.levels().len() - 1;
        match filter {
            Filter::Nearest => self.nearest(0, found),
            Filter::Bilinear => {
                self.for_each_base(0, found, |base| Some(self.bilinear(0, base, precision)));
            }
            Filter::Mipmap => {
                let nearest = |level: f64| self.texture.nearest_level(level);
                (nearest(least)..=nearest(most)).for_each(|level| self.nearest(level, found));
            }
            Filter::Trilinear => {
                let levels = [least, most].map(|level| self.texture.clamp(level));
                // Linear between whole levels: the ends, and the whole levels between them.
                let whole =
                    (levels[0].ceil() as usize..=levels[1].floor() as usize).map(|l| l as f64);
                self.for_each_base(levels[0] as usize, found, |base| {
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

    fn nearest(&self, level: usize, found: &mut dyn FnMut(Option<Range>)) {
        for texel in self.touched(level) {
            found((self.is_translucent || is_opaque(texel)).then(|| Range::of(texel)));
        }
    }

    /// Visits the ranges that `colors` returns for each texel that may be the nearest one: it
    /// decides whether a pixel is transparent, and stands in for those that are.
    fn for_each_base(
        &self,
        level: usize,
        found: &mut dyn FnMut(Option<Range>),
        colors: impl Fn(Texel) -> Option<Range>,
    ) {
        for base in self.touched(level) {
            found((self.is_translucent || is_opaque(base)).then(|| colors(base)).flatten());
            // Where all are opaque, it doesn't matter which is the nearest; nor where all are
            // mixed as they are.
            if self.is_translucent || self.texture.is_opaque() {
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
            if self.is_translucent || is_opaque(texel) { texel } else { base }
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
