//! What a renderer of some types costs: a table that `measure plan --calibrate` measures.
//!
//! Flash and stack are those of a program with these types. Cycles are a sum over what a frame has
//! of pixels, vertices, triangles and so on, each times a weight: the weights are fitted to frames
//! of bodies that are made for it, by least squares of relative errors, none below 0.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{Core, Correction, Divided, Paint, Slivers, Types, Visibility, seen::Work};

/// The table for all cores.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Costs {
    /// The compiler that it was measured with.
    pub compiler: String,
    /// For each core, by [the name of types](Types), what they cost.
    pub cores: BTreeMap<String, BTreeMap<String, Cost>>,
}

/// What one renderer costs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cost {
    /// Bytes of code and constants, without the tables of the model.
    pub flash_bytes: u32,
    /// Bytes of stack.
    pub stack_bytes: u32,
    /// The weights of [`Load`]'s parts, in cycles.
    pub cycles: [f64; PARTS],
}

/// How much there is in a frame of what takes time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load(pub [f64; PARTS]);

/// The number of parts.
const PARTS: usize = 13;

impl Load {
    /// The parts.
    pub const PARTS: [&'static str; PARTS] = [
        "pixels of the display",
        "bands",
        "vertices",
        "triangles",
        "triangles that are seen",
        "of these, without a pixel",
        "bands that meet them",
        "rows of them",
        "their pixels",
        "of these, in front",
        "triangles whose texture coordinates are divided",
        "rows of these",
        "pieces of these rows",
    ];

    /// That of a view of some vertices, on a display of some pixels in some bands, whose height has
    /// this place in [`band_rows`](super::band_rows). What one band takes is a part of the pixels,
    /// and it meets each triangle once.
    pub(super) fn of(
        work: &Work,
        types: &Types,
        vertices: u64,
        [pixels, bands]: [u32; 2],
        place: usize,
    ) -> Self {
        let Work { triangles, seen, missed, rows, covered, passed, .. } = *work;
        let divided = match types.paint {
            Paint::Textures(Correction::Adaptive, ..) => work.divided,
            _ => Divided::default(),
        };
        let met = if bands == 1 { 0 } else { work.met.get(place).copied().unwrap_or(0) };
        let bands = if bands == 1 { 0 } else { bands };
        let counts = [
            pixels.into(),
            bands.into(),
            vertices,
            triangles,
            seen,
            missed,
            met,
            rows,
            covered,
            passed,
            divided.triangles,
            divided.rows,
            divided.pieces,
        ];
        Self(counts.map(|count: u64| count as f64))
    }
}

impl Cost {
    /// The cycles of a frame.
    #[must_use]
    pub fn cycles_of(&self, load: &Load) -> f64 {
        self.cycles.iter().zip(load.0).map(|(weight, count)| weight * count).sum()
    }
}

/// What each further run of triangles of one material takes, in cycles: an order that is not the
/// converter's may have many. Those of the bodies that costs are measured with have two at most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RunCost {
    /// To begin it, in each band.
    begin: f64,
    /// To prepare its material, in each band that a triangle of it reaches.
    surface: f64,
}

impl RunCost {
    /// Estimates from what the code does, not fitted to any measurement: light of vertices prepares
    /// a ramp of 64 colours, at 30 cycles each on a Cortex-M0+ and half of that on cores with a
    /// long multiplication; other surfaces are a colour or a texture's address.
    pub(super) const fn of(core: Core, types: &Types) -> Self {
        let has_ramp = types.is_smooth && matches!(types.paint, Paint::Materials);
        let [begin, surface, ramp] = match core {
            Core::M0plus => [250.0, 50.0, 2_000.0],
            Core::M4 | Core::Riscv => [150.0, 30.0, 1_000.0],
        };
        Self { begin, surface: if has_ramp { ramp } else { surface } }
    }

    /// The cycles of some runs in a frame. A run reaches as many bands as a triangle does.
    pub(super) fn cycles_of(&self, runs: usize, load: &Load) -> f64 {
        let (bands, seen, met) = (load.0[1].max(1.0), load.0[4].max(1.0), load.0[6]);
        runs as f64 * (bands * self.begin + (met / seen).max(1.0) * self.surface)
    }
}

/// What slivers take more than other triangles: their gradients are divided exactly, and many of
/// their rows have no pixel. The bodies that costs are measured with have none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SliverCost {
    /// The cycles of each, in each band that meets it.
    planes: f64,
    /// Those of a row without a pixel.
    empty_row: f64,
}

impl SliverCost {
    /// By the figures of `measure stiffness m0plus m4 riscv`, not fitted to a plan's: what a
    /// triangle with one plane, that of 16-bit depth, takes on a base of 64 pixels if it is a
    /// quarter of a pixel high, as a sliver, and if it is a pixel high, less the 24 pixels that it
    /// has more then. A Cortex-M0+ has no long multiplication to divide by.
    ///
    /// ```text
    ///   Cortex-M0+   9,158 - (6,003 - 24 x 18)   3,600 cycles
    ///   Cortex-M4    3,847 - (4,036 - 24 x 14)     150
    ///   Hazard3      3,525 - (3,514 - 24 x 11)     280
    /// ```
    ///
    /// In a row without a pixel both edges take their step: an estimate from what the code does.
    pub(super) const fn of(core: Core, types: &Types) -> Self {
        let [plane, empty_row] = match core {
            Core::M0plus => [3_600.0, 40.0],
            Core::M4 => [150.0, 25.0],
            Core::Riscv => [280.0, 25.0],
        };
        Self { planes: types.planes() as f64 * plane, empty_row }
    }

    /// The cycles of a view's slivers in a frame of bands whose height has this place in
    /// [`band_rows`](super::band_rows).
    pub(super) fn cycles_of(&self, slivers: &Slivers, place: usize) -> f64 {
        let met = slivers.met.get(place).copied().unwrap_or(0);
        self.planes * met as f64 + self.empty_row * slivers.empty_rows as f64
    }
}

/// What parts that planes keep apart take.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct PartCost {
    /// Bytes of code.
    pub(super) flash_bytes: u32,
    /// Bytes of stack.
    pub(super) stack_bytes: u32,
    /// The cycles of each plane in a frame: a determinant of three points in clip space.
    plane: f64,
    /// Those of each plane for each part: whether it is on the viewer's side.
    side: f64,
}

impl PartCost {
    /// By programs that draw 6 and 24 boxes in parts and in the order of the mesh, which are none
    /// of the scenes of a plan. What is projected for a plane is linked for clipping, too. On a
    /// Cortex-M4 and on RISC-V up to 100,000 cycles more or fewer are what the compiler makes of
    /// the loop that sends pixels beside it: the weights are those of 24 boxes less those of 6 on
    /// the Cortex-M4.
    pub(super) const fn of(core: Core, types: &Types) -> Self {
        let ([code, shared], stack_bytes, [plane, side]) = match core {
            Core::M0plus => ([1_250, 250], 150, [2_500.0, 60.0]),
            Core::M4 => ([1_120, 150], 190, [1_600.0, 30.0]),
            Core::Riscv => ([1_450, 310], 130, [1_600.0, 30.0]),
        };
        let flash_bytes = if types.clips { code - shared } else { code };
        Self { flash_bytes, stack_bytes, plane, side }
    }

    /// The cycles of a frame.
    pub(super) fn cycles_of(&self, planes: usize) -> f64 {
        let sides = planes * (planes + 1);
        self.plane * planes as f64 + self.side * sides as f64
    }

    /// The bytes of the tables: three points and three parts for each plane, the end of each part,
    /// and the addresses and lengths of both. None without planes.
    pub(super) const fn table_bytes(planes: usize) -> usize {
        if planes == 0 { 0 } else { 22 * planes + 4 * (planes + 1) + 16 }
    }
}

impl Costs {
    /// The table that was measured.
    #[must_use]
    pub fn measured() -> Self {
        // A test reads it.
        serde_json::from_str(include_str!("costs.json")).unwrap_or_default()
    }

    /// What types cost on a core; `None` if that is unknown.
    ///
    /// [Measured](Types::all_measured) are the combinations of one shader, and of each other shader
    /// the simplest renderer with depth and without; where nothing is interpolated, all of them. Of
    /// each filter one renderer is measured with depth and one without, and of bilinear ones for
    /// each kind of texels.
    /// What else differs (visibility, bands, vertices on demand) costs the others what it costs the
    /// first shader.
    #[must_use]
    pub fn of(&self, core: Core, types: &Types) -> Option<Cost> {
        let (costs, types) = (self.cores.get(core.name())?, &types.same_code());
        if let Some(&cost) = costs.get(&types.to_string()) {
            return Some(cost);
        }
        // What types cost: that of `of` and what `with` has more than `without`.
        let [of, without, with] = if types.clips {
            let model = types.clipped_model();
            [Types { clips: false, ..*types }, model, Types { clips: true, ..model }]
        } else if let Some(steps) = types.filter_steps() {
            steps
        } else if *types == types.shader_model() {
            let with_u16 = Types { visibility: Visibility::U16, ..*types };
            [with_u16, with_u16.whole_and_stored(), types.whole_and_stored()]
        } else {
            let model = types.shader_model();
            [types.base(), model.base(), model]
        };
        // Each is simpler, and the simplest is measured.
        let is_simpler = [of, without, with].iter().all(|other| other != types);
        let cost = |types: &Types| self.of(core, types).filter(|_| is_simpler);
        Some(cost(&of)?.plus(cost(&without)?, cost(&with)?))
    }
}

impl Cost {
    /// The cost with what `other` has more than `base`.
    fn plus(self, base: Self, other: Self) -> Self {
        let add = |own: u32, base: u32, other: u32| (own + other).saturating_sub(base);
        Self {
            flash_bytes: add(self.flash_bytes, base.flash_bytes, other.flash_bytes),
            stack_bytes: add(self.stack_bytes, base.stack_bytes, other.stack_bytes),
            cycles: std::array::from_fn(|part| {
                (self.cycles[part] + other.cycles[part] - base.cycles[part]).max(0.0)
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{super::Vertices, *};

    #[test]
    fn slivers_take_longer_for_each_plane_and_band() {
        let slivers = Slivers { met: vec![10, 14], empty_rows: 5 };
        let gouraud = Types { visibility: Visibility::MeshOrder, ..GOURAUD };
        let flat = Types { is_smooth: false, ..gouraud };
        let cycles =
            |core, types: &Types, place| SliverCost::of(core, types).cycles_of(&slivers, place);
        let (plane, rows) = (3_600.0, 5.0 * 40.0);
        assert_eq!(cycles(Core::M0plus, &gouraud, 0), 10.0 * plane + rows);
        assert_eq!(cycles(Core::M0plus, &gouraud, 1), 14.0 * plane + rows);
        assert_eq!(cycles(Core::M0plus, &GOURAUD, 1), 28.0 * plane + rows);
        // Neither depth nor light is interpolated.
        assert_eq!(cycles(Core::M0plus, &flat, 1), rows);
        assert_eq!(cycles(Core::M4, &GOURAUD, 1), 28.0 * 150.0 + 5.0 * 25.0);
    }

    #[test]
    fn parts_cost_what_their_planes_do() {
        let clipped = Types { clips: true, ..GOURAUD };
        let [cost, with_clipping] =
            [GOURAUD, clipped].map(|types| PartCost::of(Core::M0plus, &types));
        assert_eq!(cost.cycles_of(0), 0.0);
        assert_eq!(cost.cycles_of(3), 3.0 * 2_500.0 + 3.0 * 4.0 * 60.0);
        assert_eq!(cost.flash_bytes - with_clipping.flash_bytes, 250);
        assert_eq!([0, 3].map(PartCost::table_bytes), [0, 3 * 22 + 4 * 4 + 16]);
    }

    const GOURAUD: Types = Types {
        is_smooth: true,
        paint: Paint::Materials,
        visibility: Visibility::U16,
        in_bands: true,
        vertices: Vertices::Stored,
        clips: false,
    };

    #[test]
    fn all_types_have_costs_on_all_cores() {
        let costs = Costs::measured();
        for (_, core) in Core::NAMES {
            for types in Types::all() {
                let cost = costs.of(core, &types);
                let cost = cost.unwrap_or_else(|| panic!("{types} on {}", core.title()));
                assert!(cost.flash_bytes > 1_000 && cost.stack_bytes > 100, "{types}: {cost:?}");
                let clipped = costs.of(core, &Types { clips: true, ..types });
                assert!(clipped.is_some_and(|clipped| clipped.flash_bytes >= cost.flash_bytes));
            }
        }
    }
}
