//! The two triangular sweeps over a supernodal factor, L y = b and Lᵀ x = y, for one right-hand side or several in
//! lockstep.
//!
//! ```text
//! panel of columns a … b:   [ D ]   lower triangle, dense          forward    y_a = D⁻¹ y_a,   y_r −= R y_a
//!                           [ R ]   rows r further down, dense     backward   x_a = D⁻ᵀ (y_a − Rᵀ x_r)
//! ```
//!
//! A step of a large bridge is bound by reading L once in either sweep. So each panel is read front to back, four columns
//! at a time, against a short buffer that stays in the first-level cache; the instruction set is chosen at run time (crate
//! pulp). Several right-hand sides stand interleaved, [`LANES`] numbers to a row, and share the traffic.

mod kernels;
mod many;
mod one;
mod panels;

use pulp::{Arch, Simd, WithSimd};

pub use kernels::LANES;
pub(crate) use kernels::add;
pub use panels::{Panels, Which};

/// A sweep as pulp wants it: what is in [`WithSimd::with_simd`] is compiled for the CPU at hand, a closure may not be.
struct Sweep<'a, const FORWARD: bool, const MANY: bool> {
    panels: &'a Panels<'a>,
    y: &'a mut [f64],
    buffer: &'a mut [f64],
    which: Which<'a>,
}

impl<const FORWARD: bool, const MANY: bool> WithSimd for Sweep<'_, FORWARD, MANY> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { panels, y, buffer, which } = self;
        let (count, n) = (which.len(panels.count()), panels.inverse_diagonal.len());
        for i in 0..count {
            let s = which.at(if FORWARD { i } else { count - 1 - i });
            match (FORWARD, MANY) {
                (true, false) => panels.forward_panel(s, y, buffer),
                (false, false) => panels.backward_panel(simd, s, y, buffer),
                (true, true) => groups(y, n).for_each(|y| panels.forward_panel_many(simd, s, y, buffer)),
                (false, true) => groups(y, n).for_each(|y| panels.backward_panel_many(simd, s, y, buffer)),
            }
        }
    }
}

impl Panels<'_> {
    /// y ← L⁻¹ y over `which` panels; `buffer` holds as much as the highest panel has rows.
    pub fn forward(&self, y: &mut [f64], buffer: &mut [f64], which: Which) {
        Arch::new().dispatch(Sweep::<true, false> { panels: self, y, buffer, which });
    }

    /// y ← L⁻ᵀ y over `which` panels, from the last to the first.
    pub fn backward(&self, y: &mut [f64], buffer: &mut [f64], which: Which) {
        Arch::new().dispatch(Sweep::<false, false> { panels: self, y, buffer, which });
    }

    /// Y ← L⁻¹ Y over `which` panels.
    pub fn forward_many(&self, y: &mut [f64], buffer: &mut [f64], which: Which) {
        Arch::new().dispatch(Sweep::<true, true> { panels: self, y, buffer, which });
    }

    /// Y ← L⁻ᵀ Y over `which` panels, from the last to the first.
    pub fn backward_many(&self, y: &mut [f64], buffer: &mut [f64], which: Which) {
        Arch::new().dispatch(Sweep::<false, true> { panels: self, y, buffer, which });
    }
}

/// Groups of [`LANES`] right-hand sides with n rows.
#[inline(always)]
fn groups(y: &mut [f64], n: usize) -> impl Iterator<Item = &mut [[f64; LANES]]> {
    y.as_chunks_mut().0.chunks_exact_mut(n)
}
