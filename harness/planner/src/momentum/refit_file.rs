//! What a plan reads of a refit: centre of mass, scale of sunlight and their covariance, from its JSON.

use serde::Deserialize;

/// A refit.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct RefitValues {
    /// Name of the spacecraft, where the file gives it.
    pub spacecraft: Option<String>,
    /// Body frame, in m.
    #[serde(rename = "centerOfMass_m")]
    pub center_of_mass_m: [f64; 3],
    /// Factor of force and torque of direct sunlight.
    pub scale: f64,
    /// Of both, row by row.
    pub covariance: [[f64; 4]; 4],
}

/// Reads the JSON of a refit.
///
/// # Errors
/// What is missing or of another kind, and a covariance that is none.
pub fn read(text: &str) -> Result<RefitValues, String> {
    let found: RefitValues = serde_json::from_str(text).map_err(|error| error.to_string())?;
    let matrix = nalgebra::Matrix4::from(found.covariance);
    let scale = matrix.amax();
    let least = matrix.symmetric_eigenvalues().min();
    if (matrix - matrix.transpose()).amax() > 1e-9 * scale || least < -1e-9 * scale {
        return Err("a covariance that is not symmetric or has a negative variance".to_owned());
    }
    if found.scale <= 0.0 {
        return Err(format!("the scale {}", found.scale));
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    //! Fields by name; what is no covariance is refused.
    use super::*;

    #[test]
    fn fields_are_read_by_name_and_a_bad_covariance_is_refused() {
        let text = |last: f64| {
            format!(
                r#"{{"centerOfMass_m": [0.01, 0.02, 0.03], "scale": 1.1, "chiSquare": 3,
                "covariance": [[1e-6,0,0,0],[0,4e-6,0,0],[0,0,1e-6,0],[0,0,0,{last}]]}}"#
            )
        };
        let found = read(&text(1e-4)).unwrap();
        assert_eq!((found.center_of_mass_m[2], found.scale, found.covariance[1][1]), (0.03, 1.1, 4e-6));
        assert!(read(&text(-1e-4)).unwrap_err().contains("negative variance"));
        assert!(read("{}").unwrap_err().contains("centerOfMass_m"));
    }
}
