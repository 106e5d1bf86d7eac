//! Second-order sections in a row, each in transposed direct form II:
//!
//! ```text
//! y   = b₀ x + z₀                    H(z) = (b₀ + b₁ z⁻¹ + b₂ z⁻²)/(1 + a₁ z⁻¹ + a₂ z⁻²)
//! z₀' = b₁ x − a₁ y + z₁
//! z₁' = b₂ x − a₂ y
//! ```
//!
//! Bilinear transform with s = 2 f_s (z − 1)/(z + 1). The steady state under a constant input x is that of the gain
//! G = Σb/Σa: z₁ = (b₂ − a₂ G) x, z₀ = (b₁ − a₁ G) x + z₁; the next section sees G x.

/// Coefficients of one section; a₀ = 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// b₀, b₁, b₂.
    pub b: [f64; 3],
    /// a₁, a₂.
    pub a: [f64; 2],
}

impl Section {
    /// The section of (n₀ + n₁ s + n₂ s²)/(d₀ + d₁ s + d₂ s²) by the bilinear transform without prewarping, `rate` values a
    /// second.
    pub fn bilinear(n: [f64; 3], d: [f64; 3], rate: f64) -> Self {
        let k = 2.0 * rate;
        let transformed =
            |[p0, p1, p2]: [f64; 3]| [p0 + p1 * k + p2 * k * k, 2.0 * (p0 - p2 * k * k), p0 - p1 * k + p2 * k * k];
        let (b, a) = (transformed(n), transformed(d));
        Self { b: b.map(|value| value / a[0]), a: [a[1] / a[0], a[2] / a[0]] }
    }

    /// Gain at frequency zero.
    fn constant_gain(&self) -> f64 {
        self.b.iter().sum::<f64>() / (1.0 + self.a[0] + self.a[1])
    }

    /// |H| squared at the normalised angle ω = 2πf/f_s.
    fn gain_squared(&self, omega: f64) -> f64 {
        let amount = |p: [f64; 3]| {
            let re = p[0] + p[1] * omega.cos() + p[2] * (2.0 * omega).cos();
            let im = p[1] * omega.sin() + p[2] * (2.0 * omega).sin();
            re * re + im * im
        };
        amount(self.b) / amount([1.0, self.a[0], self.a[1]])
    }
}

/// Sections in a row.
#[derive(Clone, Debug, PartialEq)]
pub struct Cascade {
    sections: Vec<Section>,
}

impl Cascade {
    /// In this order.
    pub fn new(sections: Vec<Section>) -> Self {
        Self { sections }
    }

    /// The sections.
    pub fn sections(&self) -> &[Section] {
        &self.sections
    }

    /// |H| at `frequency`, Hz, with `rate` values a second.
    pub fn gain(&self, frequency: f64, rate: f64) -> f64 {
        let omega = 2.0 * std::f64::consts::PI * frequency / rate;
        self.sections.iter().map(|section| section.gain_squared(omega)).product::<f64>().sqrt()
    }

    /// Over records side by side in place, from rest: `signal` holds a value of each of them, then the next of each.
    pub fn from_rest<const N: usize>(&self, signal: &mut [[f64; N]]) {
        self.run(signal.iter_mut(), |_, _| [0.0; 2]);
    }

    /// The same from the steady state that belongs to each first value.
    pub(crate) fn run_from_steady<'a, const N: usize>(&self, signal: impl Iterator<Item = &'a mut [f64; N]>) {
        self.run(signal, |section, x| {
            let (g, [_, b1, b2], [a1, a2]) = (section.constant_gain(), section.b, section.a);
            let z1 = b2 - a2 * g;
            [(b1 - a1 * g + z1) * x, z1 * x]
        });
    }

    fn run<'a, const N: usize>(
        &self,
        signal: impl Iterator<Item = &'a mut [f64; N]>,
        start: impl Fn(&Section, f64) -> [f64; 2],
    ) {
        let mut signal = signal.peekable();
        let mut first = signal.peek().map_or([0.0; N], |x| **x);
        let mut states: Vec<[[f64; N]; 2]> = Vec::with_capacity(self.sections.len());
        for section in &self.sections {
            let z = first.map(|x| start(section, x));
            states.push([z.map(|z| z[0]), z.map(|z| z[1])]);
            first = first.map(|x| x * section.constant_gain());
        }
        for values in signal {
            for (section, [z0, z1]) in self.sections.iter().zip(&mut states) {
                let ([b0, b1, b2], [a1, a2], x) = (section.b, section.a, *values);
                // Records wait for themselves only, so that several take hardly longer than one.
                for i in 0..N {
                    let y = b0 * x[i] + z0[i];
                    z0[i] = b1 * x[i] - a1 * y + z1[i];
                    z1[i] = b2 * x[i] - a2 * y;
                    values[i] = y;
                }
            }
        }
    }
}
