//! Where an effect is tried of which a search says nothing: past its onset it does nothing, nor does one without size in whatever
//! shape, and from there no slope leads to where it does something.

use super::fit::Coordinate;

/// Sizes that are tried all over their range.
const SIZES: usize = 8;
/// Parts of the size where a search starts that are tried as well.
const SMALLER: [f64; 3] = [0.1, 0.3, 1.0];
/// Share of a shape's range that lies between the values of it that are tried with them.
const ASIDE: f64 = 0.07;

/// Places at which an effect is tried, given its coordinates as a search starts from them, the size first: all over the range of
/// sizes; and at and below the size where a search starts, with the shape, if it has one, to both sides of where that starts.
pub fn sizes(own: &[Coordinate]) -> Vec<Vec<f64>> {
    let Some((size, shapes)) = own.split_first() else { return Vec::new() };
    let all_over = (0..SIZES).map(|k| size.low + (size.high - size.low) * (k as f64 + 0.5) / SIZES as f64);
    let mut places: Vec<Vec<f64>> = all_over.map(|size| vec![size]).collect();
    for part in SMALLER {
        places.push(vec![part * size.start]);
        if let Some(shape) = shapes.first() {
            let aside = ASIDE * (shape.high - shape.low);
            let beside = [shape.start - aside, shape.start + aside].map(|shape| vec![part * size.start, shape]);
            places.extend(beside);
        }
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    fn coordinate(low: f64, high: f64, start: f64) -> Coordinate {
        Coordinate { name: String::new(), low, high, start, prior: None }
    }

    #[test]
    fn small_sizes_are_tried_in_shapes_to_both_sides() {
        let places = sizes(&[coordinate(0.0, 5.0, 0.05), coordinate(-0.5, 3.0, 1.0), coordinate(0.0, 1.0, 0.5)]);
        assert_eq!(places.len(), SIZES + 3 * SMALLER.len());
        assert!(places.iter().all(|own| (0.0..=5.0).contains(&own[0])));
        let shapes = |size: f64| -> Vec<f64> {
            places.iter().filter(|own| own[0] == size && own.len() == 2).map(|own| own[1]).collect()
        };
        for part in SMALLER {
            let [below, above] = shapes(part * 0.05)[..] else { panic!("two shapes") };
            assert!(below < 1.0 && 1.0 < above && below > -0.5 && above < 3.0);
        }
    }

    #[test]
    fn a_size_alone_is_tried_alone() {
        let places = sizes(&[coordinate(-1.0, 1.0, 0.01)]);
        assert_eq!(places.len(), SIZES + SMALLER.len());
        assert!(places.iter().all(|own| own.len() == 1));
    }
}
