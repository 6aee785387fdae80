"""The only place that speaks OpenCascade; it knows curves, faces and solids, no jewellery."""
