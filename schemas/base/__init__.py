"""What every model is made of: fields with units, rules between fields, hints for forms, the version."""
