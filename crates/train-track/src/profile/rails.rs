//! Irregularity of both rails from level, alignment, cross-level and gauge.
//!
//! ```text
//! a_L, a_R = alignment ∓ gauge/2          lateral, to the right
//! r_L, r_R = level ∓ cross-level/2        down
//! ```
//!
//! Random components have phases of their own, drawn from one seed: streams 0 (level), 1, 2, 3 of its generator.

use ttb_scenario::spec::{SpaceIrregularity, TrainTrackSpec};

use super::Irregularity;

/// Four components, ready to be evaluated.
#[derive(Clone, Debug)]
pub struct Rails {
    level: Irregularity,
    alignment: Irregularity,
    cross_level: Irregularity,
    gauge: Irregularity,
}

/// Of one rail at one place, m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct At {
    /// To the right.
    pub lateral: f64,
    /// Down.
    pub down: f64,
}

impl Rails {
    /// Of a specification in space; `scale` multiplies all components, `seed` replaces the random ones' seed.
    #[must_use]
    pub fn new(
        spec: &TrainTrackSpec,
        space: &SpaceIrregularity,
        scale: f64,
        passage: [f64; 2],
        seed: Option<u64>,
    ) -> Self {
        let component = |profile, stream| Irregularity::component(profile, scale, passage, seed, stream);
        Self {
            level: component(&spec.irregularity, 0),
            alignment: component(&space.alignment, 1),
            cross_level: component(&space.cross_level, 2),
            gauge: component(&space.gauge, 3),
        }
    }

    /// The left and the right rail at an abscissa.
    #[must_use]
    pub fn at(&self, x: f64) -> [At; 2] {
        let [level, alignment] = [&self.level, &self.alignment].map(|component| component.at(x));
        let [twist, gauge] = [&self.cross_level, &self.gauge].map(|component| 0.5 * component.at(x));
        [-1.0, 1.0].map(|side| At { lateral: alignment + side * gauge, down: level + side * twist })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ttb_scenario::bundled;
    use ttb_scenario::spec::Profile;

    /// One seed, phases of their own: each component has its spectrum's σ, and no two of them go together.
    #[test]
    fn random_components_have_their_sigma_and_phases_of_their_own() {
        let all = bundled::lateral("german-low").expect("bundled");
        let densities = [bundled::spectrum("german-low").expect("bundled"), all.alignment, all.cross_level, all.gauge];
        let band = [3.0, 25.0];
        let rail = |(stream, density): (u8, &ttb_scenario::spec::Density)| {
            let ramp = Some(ttb_scenario::types::Ramp { start: -1.0, length: 0.0, shape: Default::default() });
            let profile = Profile::Spectrum { density: density.clone(), seed: 7, wavelengths: band, ramp };
            Irregularity::component(&profile, 1.0, [0.0, 500.0], None, stream)
        };
        let rails: Vec<Irregularity> = (0..).zip(&densities).map(rail).collect();
        let n = 8192;
        let samples: Vec<Vec<f64>> =
            rails.iter().map(|rail| (0..n).map(|i| rail.at(0.5 * f64::from(i))).collect()).collect();
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>() / f64::from(n);
        let sigmas: Vec<f64> = samples.iter().map(|r| dot(r, r).sqrt()).collect();
        // Over a whole period the sample's σ is that of its band.
        for (sigma, density) in sigmas.iter().zip(&densities) {
            let known = density.sigma(band[0], band[1]);
            assert!((sigma / known - 1.0).abs() < 5e-3, "{sigma} {known}");
        }
        for (i, a) in samples.iter().enumerate() {
            for (j, b) in samples.iter().enumerate().skip(i + 1) {
                let correlation = dot(a, b) / (sigmas[i] * sigmas[j]);
                assert!(correlation.abs() < 0.15, "{i} {j}: {correlation}");
            }
        }
    }
}
