//! Amplitude spectrum of samples, by a fast Fourier transform under Hann's window.
//!
//! Method: radix-2 transform of Cooley and Tukey. A line whose frequency is that of a bin shows with its amplitude; noise counts
//! 1.5 bins wide under this window.
//! Reference: Harris, On the Use of Windows for Harmonic Analysis with the Discrete Fourier Transform, Proc. IEEE 66 (1), 1978.

use nalgebra::Complex;

/// Width of a bin under Hann's window, in bins.
const NOISE_BINS: f64 = 1.5;

/// Amplitudes by frequency.
pub(super) struct Spectrum {
    bin_hz: f64,
    amplitudes: Vec<f64>,
}

impl Spectrum {
    /// Of a power of two of samples, so many a second; their mean is taken off.
    pub(super) fn of(samples: &[f64], rate_hz: f64) -> Self {
        let count = samples.len();
        let mean = samples.iter().sum::<f64>() / count as f64;
        let windowed = samples.iter().enumerate().map(|(k, x)| {
            let phase = std::f64::consts::TAU * k as f64 / count as f64;
            Complex::from((x - mean) * (1.0 - phase.cos()))
        });
        let mut values: Vec<Complex<f64>> = windowed.collect();
        transform(&mut values);
        let amplitudes = values[..count / 2].iter().map(|value| value.norm() * 2.0 / count as f64).collect();
        Self { bin_hz: rate_hz / count as f64, amplitudes }
    }

    /// The frequency of a bin that is nearest to one, in Hz.
    pub(super) fn nearest_hz(count: usize, rate_hz: f64, frequency_hz: f64) -> f64 {
        let bin_hz = rate_hz / count as f64;
        (frequency_hz / bin_hz).round() * bin_hz
    }

    /// Frequencies in Hz and amplitudes between two frequencies.
    pub(super) fn between(&self, from_hz: f64, to_hz: f64) -> impl Iterator<Item = (f64, f64)> {
        let points =
            self.amplitudes.iter().enumerate().map(|(k, amplitude)| (k as f64 * self.bin_hz, *amplitude));
        points.filter(move |(frequency_hz, _)| (from_hz..=to_hz).contains(frequency_hz))
    }

    /// The greatest of them, with its frequency in Hz.
    pub(super) fn greatest(&self, from_hz: f64, to_hz: f64) -> (f64, f64) {
        self.between(from_hz, to_hz).fold((0.0, 0.0), |most, it| if it.1 > most.1 { it } else { most })
    }

    /// The root of the sum of squares of several, bin by bin, each amplitude taken by `of` its frequency in Hz.
    pub(super) fn combined(spectra: &[Self], of: impl Fn(f64, f64) -> f64) -> Self {
        let bin_hz = spectra.first().map_or(0.0, |it| it.bin_hz);
        let count = spectra.iter().map(|it| it.amplitudes.len()).min().unwrap_or(0);
        let amplitude = |k: usize| {
            let squares = spectra.iter().map(|it| of(k as f64 * bin_hz, it.amplitudes[k]).powi(2));
            squares.sum::<f64>().sqrt()
        };
        Self { bin_hz, amplitudes: (0..count).map(amplitude).collect() }
    }

    /// Root of the mean square of what lies between two frequencies.
    pub(super) fn rms(&self, from_hz: f64, to_hz: f64) -> f64 {
        let squares: f64 = self.between(from_hz, to_hz).map(|(_, amplitude)| amplitude * amplitude).sum();
        (0.5 * squares / NOISE_BINS).sqrt()
    }
}

/// The discrete Fourier transform of a power of two of values, in place.
fn transform(values: &mut [Complex<f64>]) {
    let count = values.len();
    if count < 2 {
        return;
    }
    let (mut even, mut odd): (Vec<_>, Vec<_>) = values.chunks_exact(2).map(|pair| (pair[0], pair[1])).unzip();
    transform(&mut even);
    transform(&mut odd);
    for k in 0..count / 2 {
        let turned = odd[k] * Complex::from_polar(1.0, -std::f64::consts::TAU * k as f64 / count as f64);
        values[k] = even[k] + turned;
        values[k + count / 2] = even[k] - turned;
    }
}

#[cfg(test)]
mod tests {
    //! Against sums of sines, and white noise's known power.
    use super::*;

    const COUNT: usize = 4096;
    const RATE_HZ: f64 = 50.0;

    fn sine(amplitude: f64, frequency_hz: f64) -> Vec<f64> {
        (0..COUNT)
            .map(|k| amplitude * (std::f64::consts::TAU * frequency_hz * k as f64 / RATE_HZ + 0.3).sin())
            .collect()
    }

    #[test]
    fn lines_show_with_frequency_amplitude_and_power() {
        let [slow, fast] = [3.0, 11.0].map(|hz| Spectrum::nearest_hz(COUNT, RATE_HZ, hz));
        let samples: Vec<f64> =
            sine(2.0, slow).iter().zip(sine(0.01, fast)).map(|(a, b)| a + b + 7.0).collect();
        let spectrum = Spectrum::of(&samples, RATE_HZ);
        for (frequency_hz, amplitude) in [(slow, 2.0), (fast, 0.01)] {
            let (found_hz, found) = spectrum.greatest(frequency_hz - 1.0, frequency_hz + 1.0);
            assert!((found_hz - frequency_hz).abs() < 1e-9, "{found_hz}");
            assert!((found / amplitude - 1.0).abs() < 1e-9, "{found}");
        }
        assert!((spectrum.rms(1.0, 5.0) / 2.0_f64.sqrt() - 1.0).abs() < 1e-6);
        let both =
            Spectrum::combined(&[Spectrum::of(&samples, RATE_HZ), Spectrum::of(&samples, RATE_HZ)], |_, a| a);
        assert!((both.greatest(0.1, 25.0).1 / 8.0_f64.sqrt() - 1.0).abs() < 1e-9);
    }

    #[test]
    fn noise_has_its_standard_deviation() {
        let mut seed = 1_u64;
        let noise: Vec<f64> = (0..1 << 15)
            .map(|_| {
                seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
            })
            .collect();
        let found = Spectrum::of(&noise, RATE_HZ).rms(0.0, RATE_HZ);
        assert!((found * 12.0_f64.sqrt() - 1.0).abs() < 0.02, "{found}");
    }
}
