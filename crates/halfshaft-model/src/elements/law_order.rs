//! Whether stages and points of a law stand in an order that makes a law.

use super::shaft::Shaft;
use super::stage::Stage;

/// What is wrong with the order of a list of numbers of a shaft.
#[derive(Clone, Debug, PartialEq)]
pub struct LawFault {
    /// Key of the list.
    pub list: &'static str,
    /// Entry of a list of tables, and the key within it that is wrong.
    pub entry: Option<(usize, &'static str)>,
    /// What is wrong.
    pub message: String,
    /// What to write instead.
    pub hint: &'static str,
}

/// Most points of a measured law.
const MOST_POINTS: usize = 10_000;

impl Shaft {
    /// What keeps stages and table from being a law: limits that do not ascend, columns of
    /// different length, fewer than two points.
    pub fn law_faults(&self) -> Vec<LawFault> {
        let mut faults = Vec::new();
        stage_faults("stages", &self.stages, &mut faults);
        stage_faults("coast_stages", &self.coast_stages, &mut faults);
        faults.extend(self.table_fault());
        faults.extend(self.bar_fault());
        faults
    }

    fn bar_fault(&self) -> Option<LawFault> {
        let bar = self.dimensions.as_ref()?;
        (bar.inner_diameter_m >= bar.outer_diameter_m).then(|| LawFault {
            list: "inner_diameter",
            entry: None,
            message: "the inner diameter is not less than the outer".to_owned(),
            hint: "a bar needs a wall",
        })
    }

    fn table_fault(&self) -> Option<LawFault> {
        let table = self.table.as_ref()?;
        let (twists, torques) = (&table.twist_rad, &table.torque_nm);
        let fault = |message, hint| Some(LawFault { list: "table", entry: None, message, hint });
        if twists.len() != torques.len() {
            let message =
                format!("the table has {} twists and {} torques", twists.len(), torques.len());
            return fault(message, "each twist needs its torque");
        }
        if twists.len() < 2 {
            return fault("the table has fewer than two points".to_owned(), "add points");
        }
        if twists.len() > MOST_POINTS {
            let message = format!("the table has {} points", twists.len());
            return fault(message, "thin it out: up to 10 000 points are taken");
        }
        let at = twists.windows(2).position(|pair| pair[1] <= pair[0])?;
        let message = format!("the twists do not ascend from point {} to {}", at + 1, at + 2);
        fault(message, "order the points by twist, each twist once")
    }
}

fn stage_faults(list: &'static str, stages: &[Stage], faults: &mut Vec<LawFault>) {
    let mut fault = |index, key, message, hint| {
        faults.push(LawFault { list, entry: Some((index, key)), message, hint });
    };
    let Some(last) = stages.len().checked_sub(1) else { return };
    let mut reached = 0.0;
    for (index, stage) in stages.iter().enumerate() {
        let number = index + 1;
        match stage.until_rad {
            None if index < last => {
                let message = format!("stage {number} has no \"until\", and others follow");
                fault(index, "stiffness", message, "only the last stage goes on for ever");
            }
            Some(_) if index == last => {
                let message = "the last stage has an \"until\"".to_owned();
                let hint =
                    "leave it out, or add a stage for what comes beyond: { stiffness = ... }";
                fault(index, "until", message, hint);
            }
            Some(until) if until <= reached => {
                let message =
                    format!("stage {number} ends where the one before it does, or sooner");
                fault(
                    index,
                    "until",
                    message,
                    "order the stages by until, from zero twist outwards",
                );
            }
            Some(until) => reached = until,
            None => {}
        }
    }
}
