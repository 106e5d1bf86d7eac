//! Alignment, cross-level and gauge beside the level.
//!
//! ```text
//! a_L, a_R = alignment ∓ gauge/2          r_L, r_R = level ∓ cross-level/2
//! ```

use std::path::Path;

use super::columns;
use crate::bundled;
use crate::problem::Report;
use crate::spec::{Profile, SpaceIrregularity};
use crate::types::{Irregularity, IrregularityInSpace, Ramp, Wave};

const BASE: &str = "$.space.irregularity";

/// What is given, or the components that belong to a random level.
pub(super) fn chosen(given: Option<&IrregularityInSpace>, level: Option<&Irregularity>) -> IrregularityInSpace {
    match (given, level) {
        (Some(given), _) => given.clone(),
        (None, Some(Irregularity::Spectrum { spectrum, seed, wavelengths, ramp, .. }))
            if bundled::lateral(spectrum).is_some() =>
        {
            IrregularityInSpace::Spectrum {
                spectrum: spectrum.clone(),
                seed: *seed,
                wavelengths: *wavelengths,
                ramp: ramp.clone(),
            }
        }
        _ => IrregularityInSpace::None,
    }
}

/// The components, and a measured level.
pub(super) fn resolve(
    chosen: &IrregularityInSpace,
    level: Option<&Irregularity>,
    base_dir: &Path,
    report: &mut Report,
) -> Option<(SpaceIrregularity, Option<Profile>)> {
    let none = || SpaceIrregularity { alignment: Profile::None, cross_level: Profile::None, gauge: Profile::None };
    match chosen {
        IrregularityInSpace::None => Some((none(), None)),
        IrregularityInSpace::Harmonics { alignment, cross_level, gauge, origin, ramp } => {
            let waves = |waves: &[Wave]| match waves {
                [] => Profile::None,
                waves => Profile::Waves { waves: waves.to_vec(), origin: *origin, ramp: ramp.clone() },
            };
            let (alignment, cross_level, gauge) = (waves(alignment), waves(cross_level), waves(gauge));
            Some((SpaceIrregularity { alignment, cross_level, gauge }, None))
        }
        IrregularityInSpace::Spectrum { spectrum, seed, wavelengths, ramp } => {
            let [short, long] = *wavelengths;
            if !(0.0 < short && short < long) {
                let rule = "wavelengths must be [shortest, longest] with 0 < shortest < longest";
                report.problem(format!("{BASE}.wavelengths"), rule, format!("[{short}, {long}]"));
            }
            if let Some(Irregularity::Spectrum { seed: other, .. }) = level
                && other != seed
            {
                let rule = "must be the seed of the level, irregularity.seed: one seed draws all components";
                report.problem(format!("{BASE}.seed"), rule, format!("{seed} ≠ {other}"));
            }
            let densities = bundled::lateral(spectrum)?;
            let profile =
                |density| Profile::Spectrum { density, seed: *seed, wavelengths: *wavelengths, ramp: ramp.clone() };
            let [alignment, cross_level, gauge] =
                [densities.alignment, densities.cross_level, densities.gauge].map(profile);
            Some((SpaceIrregularity { alignment, cross_level, gauge }, None))
        }
        IrregularityInSpace::Measured { file, ramp } => measured(file, ramp.as_ref(), level, base_dir, report),
    }
}

fn measured(
    file: &str,
    ramp: Option<&Ramp>,
    level: Option<&Irregularity>,
    base_dir: &Path,
    report: &mut Report,
) -> Option<(SpaceIrregularity, Option<Profile>)> {
    let path = format!("{BASE}.file");
    let asked: [&[&str]; 2] = [&["x", "alignment", "cross_level", "gauge"], &["level"]];
    let columns = columns(file, base_dir, asked, &path, report)?;
    let [x, alignment, cross_level, gauge, own] = <[_; 5]>::try_from(columns).ok()?;
    let x = x?;
    let samples = |r: Vec<f64>| Profile::Samples { x: x.clone(), r, ramp: ramp.cloned() };
    if own.is_some() && !matches!(level, None | Some(Irregularity::None)) {
        let rule = "the level is given twice: by a column `level` and by the key irregularity";
        report.problem(&path, rule, file);
    }
    let (alignment, cross_level, gauge) = (samples(alignment?), samples(cross_level?), samples(gauge?));
    Some((SpaceIrregularity { alignment, cross_level, gauge }, own.map(samples)))
}

/// Standard deviation of a profile over what the scenario gives, m.
pub(crate) fn sigma_of(profile: &Profile) -> f64 {
    match profile {
        Profile::None => 0.0,
        Profile::Waves { waves, .. } => waves.iter().map(|wave| 0.5 * wave.amplitude.powi(2)).sum::<f64>().sqrt(),
        Profile::Spectrum { density, wavelengths: [short, long], .. } if 0.0 < *short && short < long => {
            density.sigma(*short, *long)
        }
        Profile::Spectrum { .. } => 0.0,
        Profile::Samples { r, .. } => {
            let n = r.len().max(1) as f64;
            let mean = r.iter().sum::<f64>() / n;
            (r.iter().map(|r| (r - mean).powi(2)).sum::<f64>() / n).sqrt()
        }
    }
}
