//! Campaigns of which not all channels are measured.

/// The table without some columns.
pub fn without(csv: &str, names: &[&str]) -> String {
    let header: Vec<&str> = csv.lines().next().expect("a header").split(',').collect();
    let kept = |line: &str| {
        let fields = line.split(',').zip(&header).filter(|(_, name)| !names.contains(name));
        fields.map(|(field, _)| field).collect::<Vec<_>>().join(",")
    };
    csv.lines().map(kept).collect::<Vec<_>>().join("\n") + "\n"
}
