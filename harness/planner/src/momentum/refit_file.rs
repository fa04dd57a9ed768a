//! Refit as a plan reads it: centre of mass, scale of sunlight and their covariance, from its JSON.

use serde::Deserialize;

use crate::refit::is_trusted;

/// A refit.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct RefitValues {
    /// Name of the spacecraft, where the file gives it.
    pub spacecraft: Option<String>,
    /// Body frame, in m.
    #[serde(rename = "centerOfMass_m")]
    pub center_of_mass_m: [f64; 3],
    /// Factor of force and torque of direct sunlight.
    pub scale: f64,
    /// Covariance of both, row by row.
    pub covariance: [[f64; 4]; 4],
    /// Whether the fit's residuals are no more than its noise, where the file says so.
    trusted: Option<bool>,
    chi_square: Option<f64>,
    degrees_of_freedom: Option<f64>,
}

/// Reads the JSON of a refit.
///
/// # Errors
/// A missing or wrong field, a matrix that is no covariance, a fit that is not trusted.
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
    let (chi_square, freedom) = (found.chi_square, found.degrees_of_freedom);
    let by_residuals =
        || chi_square.zip(freedom).is_none_or(|(chi_square, freedom)| is_trusted(chi_square, freedom));
    if !found.trusted.unwrap_or_else(by_residuals) {
        let [chi_square, freedom] =
            [chi_square, freedom].map(|it| it.map_or("?".to_owned(), terminal::short));
        return Err(format!(
            "a fit that is not trusted, chi square {chi_square} for {freedom} degrees of freedom: its covariance leaves no three sigma"
        ));
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
        let with = |more: &str| read(&text(1e-4).replace("\"chiSquare\": 3", more));
        assert!(with(r#""trusted": true, "chiSquare": 3"#).is_ok());
        assert!(with(r#""trusted": false"#).unwrap_err().contains("not trusted"));
        // A file without the word has the numbers.
        assert!(with(r#""chiSquare": 4317, "degreesOfFreedom": 4317"#).is_ok());
        let refused = with(r#""chiSquare": 6968, "degreesOfFreedom": 1"#).unwrap_err();
        assert!(refused.contains("chi square 6968 for 1 degrees"), "{refused}");
    }
}
