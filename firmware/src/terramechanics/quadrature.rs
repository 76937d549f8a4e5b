//! The rules that integrate the stresses over the contact.

use crate::scalar::{Scalar, Tabulated};

/// A way to integrate over the contact: a rule in a graded coordinate t on each panel, Gauss–Legendre's but for
/// [`Quadrature::SIMPSON`].
///
/// On each side of the peak stress the angle from the far end of the contact is in proportion to t² or t³. The normal
/// stress goes to zero there as a power that is not whole, which a polynomial rule alone resolves badly; the grading
/// makes it smooth and crowds the nodes where a thin shear layer lies.
#[derive(Debug, Clone, Copy)]
pub struct Quadrature {
    nodes: &'static [Node],
    grading: Grading,
    layer: Tabulated,
}

/// A node of a rule on 0 … 1.
#[derive(Debug, Clone, Copy)]
struct Node {
    abscissa: Tabulated,
    weight: Tabulated,
}

/// How angle follows from the graded coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Grading {
    None,
    Square,
    Cube,
}

/// A node placed in a panel, in the graded coordinate of the contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct PlacedNode<S> {
    /// Share of the angle between the far end of the contact and the peak, 0 … 1.
    pub share: S,
    /// Weight per unit of that share.
    pub weight: S,
}

impl Quadrature {
    /// For single precision: 8 nodes a panel, truncation error of the order of 1e-5 of the load.
    pub const FLIGHT: Self = Self { nodes: &GAUSS_8, grading: Grading::Square, layer: Tabulated::new(8.0) };
    /// For double precision: 16 nodes a panel, truncation error below 1e-7 of the load (4e-8 in 40 000 cases tried).
    pub const REFERENCE: Self = Self { nodes: &GAUSS_16, grading: Grading::Cube, layer: Tabulated::new(15.0) };

    /// Composite Simpson's rule with 20 intervals in the angle on each side of the peak stress, as
    /// [`crate::identification::hutangkabodee`] has it. Truncation error 2e-5 of the load on the seed's sand (n = 1.1), and
    /// more for smaller exponents.
    pub const SIMPSON: Self = Self { nodes: &SIMPSON_20, grading: Grading::None, layer: Tabulated::new(1e6) };

    /// The rule whose error is of the order that the scalar's rounding makes worth while.
    pub fn for_scalar<S: Scalar>() -> Self {
        if S::EPSILON > 1e-10 { Self::FLIGHT } else { Self::REFERENCE }
    }

    /// How many times K the shear displacement is where a panel ends, and shear counts as mobilised.
    pub(super) fn layer<S: Scalar>(&self) -> S {
        S::tabulated(&self.layer)
    }

    /// The graded coordinate of a share of the angle (0 … 1).
    pub(super) fn coordinate<S: Scalar>(&self, share: S) -> S {
        match self.grading {
            Grading::None => share,
            Grading::Square => share.sqrt(),
            Grading::Cube => share.powf(S::constant(1.0 / 3.0)),
        }
    }

    /// The nodes of the panel that starts at `start` and is `length` long, both in the graded coordinate.
    pub(super) fn place<S: Scalar>(&self, start: S, length: S) -> impl Iterator<Item = PlacedNode<S>> {
        let grading = self.grading;
        self.nodes.iter().map(move |node| {
            let t = start + length * S::tabulated(&node.abscissa);
            let weight = length * S::tabulated(&node.weight);
            match grading {
                Grading::None => PlacedNode { share: t, weight },
                Grading::Square => PlacedNode { share: t * t, weight: S::constant(2.0) * t * weight },
                Grading::Cube => PlacedNode { share: t * t * t, weight: S::constant(3.0) * t * t * weight },
            }
        })
    }
}

const fn node(abscissa: f64, weight: f64) -> Node {
    Node { abscissa: Tabulated::new(abscissa), weight: Tabulated::new(weight) }
}

/// Composite Simpson's rule with 20 intervals: 1, 4, 2, 4, … 2, 4, 1 sixtieths.
static SIMPSON_20: [Node; 21] = simpson();

const fn simpson<const NODES: usize>() -> [Node; NODES] {
    let intervals = (NODES - 1) as f64;
    let mut nodes = [node(0.0, 1.0 / (3.0 * intervals)); NODES];
    let mut place = 1;
    while place < NODES {
        let share = if place == NODES - 1 {
            1.0
        } else if place % 2 == 1 {
            4.0
        } else {
            2.0
        };
        nodes[place] = node(place as f64 / intervals, share / (3.0 * intervals));
        place += 1;
    }
    nodes
}

/// Zeros of the Legendre polynomial of degree 8, moved to 0 … 1, with their weights.
static GAUSS_8: [Node; 8] = [
    node(0.019_855_071_751_231_884, 0.050_614_268_145_188_13),
    node(0.101_666_761_293_186_64, 0.111_190_517_226_687_24),
    node(0.237_233_795_041_835_5, 0.156_853_322_938_943_63),
    node(0.408_282_678_752_175_1, 0.181_341_891_689_181),
    node(0.591_717_321_247_825, 0.181_341_891_689_181),
    node(0.762_766_204_958_164_5, 0.156_853_322_938_943_63),
    node(0.898_333_238_706_813_4, 0.111_190_517_226_687_24),
    node(0.980_144_928_248_768_1, 0.050_614_268_145_188_13),
];

/// Zeros of the Legendre polynomial of degree 16, moved to 0 … 1, with their weights.
static GAUSS_16: [Node; 16] = [
    node(0.005_299_532_504_175_033, 0.013_576_229_705_877_048),
    node(0.027_712_488_463_383_71, 0.031_126_761_969_323_947),
    node(0.067_184_398_806_084_12, 0.047_579_255_841_246_39),
    node(0.122_297_795_822_498_49, 0.062_314_485_627_766_94),
    node(0.191_061_877_798_678_11, 0.074_797_994_408_288_37),
    node(0.270_991_611_171_386_3, 0.084_578_259_697_501_27),
    node(0.359_198_224_610_370_54, 0.091_301_707_522_461_79),
    node(0.452_493_745_081_181_3, 0.094_725_305_227_534_25),
    node(0.547_506_254_918_818_8, 0.094_725_305_227_534_25),
    node(0.640_801_775_389_629_5, 0.091_301_707_522_461_79),
    node(0.729_008_388_828_613_7, 0.084_578_259_697_501_27),
    node(0.808_938_122_201_321_9, 0.074_797_994_408_288_37),
    node(0.877_702_204_177_501_6, 0.062_314_485_627_766_94),
    node(0.932_815_601_193_915_8, 0.047_579_255_841_246_39),
    node(0.972_287_511_536_616_3, 0.031_126_761_969_323_947),
    node(0.994_700_467_495_825, 0.013_576_229_705_877_048),
];
